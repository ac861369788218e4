// Shows a stored frame before and after the effect, and how far the result is from the library's. With ?check it does so for
// all frames and sends the figures to the server (scripts/webgpu.py).
import {Call, compare, countBindings, loadFrame, valuesOf} from './passes.js';

const element = (id) => document.getElementById(id);

async function openDevice() {
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) {
        throw new Error('This browser has no WebGPU.');
    }
    const device = await adapter.requestDevice(); // with the default limits
    device.addEventListener('uncapturederror', ({error}) => fail(error));
    return device;
}

async function loadCodes(frame) {
    const codes = new Map();
    for (const {file} of frame.calls.flatMap((call) => call.passes)) {
        if (!codes.has(file)) {
            codes.set(file, await (await fetch(`wgsl/${file}.wgsl`)).text());
        }
    }
    return codes;
}

// Runs a frame's calls. Returns what each wrote, by the output's name, and the figures of each.
async function runFrame(device, name) {
    const frame = await loadFrame(`frames/${encodeURIComponent(name)}`);
    const codes = await loadCodes(frame);
    const valuesIn = ({format, file}) => valuesOf(format, frame.files.get(file));
    const ids = new Uint16Array(frame.files.get(frame.images.materialId.file));
    const images = {irradiance: valuesIn(frame.images.irradiance)};
    if (frame.images.albedo) {
        images.albedo = valuesIn(frame.images.albedo);
    }
    const figures = [];
    for (const call of frame.calls) {
        const effect = new Call(device, frame, call, codes);
        effect.run();
        for (const [output, expected] of Object.entries(call.expected)) {
            images[output] = await effect.read(output);
            const channels = expected.format === 'r32float' ? 1 : 4;
            const against = (counts) => compare(images[output], valuesIn(expected), channels, counts);
            figures.push({
                frame: name,
                output,
                ...against((pixel) => ids[pixel] !== 0),
                largestElsewhere: against((pixel) => ids[pixel] === 0).largest,
            });
        }
    }
    const limits = [...codes].map(([file, code]) => ({file, ...countBindings(code)}));
    return {frame, images, figures, limits};
}

// Linear light as sRGB.
function encoded(light) {
    const value = Math.min(Math.max(light, 0), 1);
    return 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);
}

// The picture that irradiances, which add up, make: times albedo / pi.
function show(canvas, frame, albedo, irradiances) {
    [canvas.width, canvas.height] = frame.extent;
    const picture = new ImageData(...frame.extent);
    for (let i = 0; i < picture.data.length; ++i) {
        const light = irradiances.reduce((sum, image) => sum + image[i], 0) * (albedo ? albedo[i] : 1) / Math.PI;
        picture.data[i] = i % 4 === 3 ? 255 : encoded(frame.exposure * light);
    }
    canvas.getContext('2d').putImageData(picture, 0, 0);
}

function showFigures(figures) {
    const cells = (row) => `<td>${row.output}</td><td>${row.psnr.toFixed(1)} dB</td><td>${row.largest.toExponential(1)}</td>`;
    element('figures').innerHTML = '<tr><th>output</th><th>PSNR against the library</th><th>largest error</th></tr>' +
                                   figures.map((row) => `<tr>${cells(row)}</tr>`).join('');
}

async function showFrame(device, name) {
    element('status').textContent = `Running ${name}`;
    const {frame, images, figures} = await runFrame(device, name);
    show(element('before'), frame, images.albedo, [images.irradiance]);
    show(element('after'), frame, images.albedo, [images.scattered, images.transmitted].filter(Boolean));
    showFigures(figures);
    element('status').textContent = 'Done';
}

async function send(results) {
    await fetch('results', {method: 'POST', body: JSON.stringify(results)});
}

function fail(error) {
    element('status').textContent = error.message;
    send({error: error.message});
}

async function main() {
    const device = await openDevice();
    const names = await (await fetch('frames')).json();
    if (new URLSearchParams(location.search).has('check')) {
        const results = [];
        for (const name of names) {
            const {figures, limits} = await runFrame(device, name);
            results.push({figures, limits});
        }
        await send(results);
        return;
    }
    element('frame').append(...names.map((name) => new Option(name)));
    element('frame').addEventListener('change', ({target}) => showFrame(device, target.value).catch(fail));
    await showFrame(device, names[0]);
    if (isPictured) {
        await send({});
    }
}

// A browser that saves a picture does so once all has loaded: also an image that comes when the frame is shown.
const isPictured = new URLSearchParams(location.search).has('picture');
if (isPictured) {
    document.body.append(Object.assign(new Image(), {src: 'shown', hidden: true}));
}

main().catch(fail);
