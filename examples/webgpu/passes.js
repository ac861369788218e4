// The effect's passes in WebGPU: a stored frame (docs/webgpu.md) and the modules of its passes. What an engine does with
// nacre_passes.h, from the same lists, written down in frame.json.

// The bindings that a module declares, as entries of a GPUBindGroupLayout. They are numbered by constants of the module.
function layoutEntries(code) {
    const constants = new Map([...code.matchAll(/const (\w+): u32 = (\d+)u?;/g)].map((match) => [match[1], Number(match[2])]));
    const numberOf = (expression) => expression.split('+').reduce((sum, term) => sum + constants.get(term.trim()), 0);
    const declarations = code.matchAll(/@group\(0\) @binding\(([^)]+)\)\s+var(<[^>]*>)?\s+\w+\s*:\s*([^;]+);/g);
    return [...declarations].map(([, number, space, type]) => ({
        binding: numberOf(number),
        visibility: GPUShaderStage.COMPUTE,
        ...resourceOf(space, type),
    }));
}

function resourceOf(space, type) {
    if (space !== undefined) {
        const kinds = {'<uniform>': 'uniform', '<storage, read>': 'read-only-storage', '<storage, read_write>': 'storage'};
        return {buffer: {type: kinds[space]}};
    }
    const stored = type.match(/texture_storage_2d<(\w+), write>/);
    if (stored) {
        return {storageTexture: {access: 'write-only', format: stored[1]}};
    }
    const sampleType = type.includes('u32') ? 'uint' : 'unfilterable-float';
    return {texture: {sampleType, viewDimension: type.includes('array') ? '2d-array' : '2d'}};
}

// What a pass takes of WebGPU's limits.
export function countBindings(code) {
    const entries = layoutEntries(code);
    const count = (is) => entries.filter(is).length;
    return {
        storageBuffers: count((entry) => entry.buffer && entry.buffer.type !== 'uniform'),
        sampledTextures: count((entry) => entry.texture),
        storageTextures: count((entry) => entry.storageTexture),
    };
}

async function fetchBytes(url) {
    const response = await fetch(url);
    if (!response.ok) {
        throw new Error(`${url}: ${response.status}`);
    }
    return response.arrayBuffer();
}

// A frame of `folder`, with its files.
export async function loadFrame(folder) {
    const frame = JSON.parse(new TextDecoder().decode(await fetchBytes(`${folder}/frame.json`)));
    const files = new Set(Object.values(frame.images).map((image) => image.file));
    for (const call of frame.calls) {
        Object.values(call.expected).forEach((image) => files.add(image.file));
        call.bindings.filter((binding) => binding.file).forEach((binding) => files.add(binding.file));
    }
    frame.files = new Map();
    for (const file of files) {
        frame.files.set(file, await fetchBytes(`${folder}/${file}`));
    }
    return frame;
}

function createTexture(device, format, [width, height, layers], usage) {
    return device.createTexture({format, size: [width, height, layers], usage});
}

function uploadImage(device, frame, image) {
    const texture = createTexture(device, image.format, image.extent, GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST);
    const [width, height, layers] = image.extent;
    const bytes = frame.files.get(image.file);
    device.queue.writeTexture({texture}, bytes, {bytesPerRow: bytes.byteLength / (height * layers), rowsPerImage: height},
                              [width, height, layers]);
    return texture;
}

// The constants that passes have, as nacre_passes.h numbers them.
const constantIds = {separateMaterials: 0, generalCall: 1, noMaterialIds: 1000, normalEncoding: 1001};

// The pipelines that were made, by what they were made of.
const pipelines = new Map();

function pipelineOf(device, label, code, constants) {
    const key = code + JSON.stringify(constants);
    if (!pipelines.has(key)) {
        const entries = layoutEntries(code);
        const layout = device.createBindGroupLayout({label, entries});
        const pipeline = device.createComputePipeline({
            label,
            layout: device.createPipelineLayout({bindGroupLayouts: [layout]}),
            compute: {module: device.createShaderModule({label, code}), entryPoint: 'main', constants},
        });
        pipelines.set(key, {pipeline, layout, entries});
    }
    return pipelines.get(key);
}

// One call of the effect on a frame: its buffers, textures and pipelines. `codes`: the modules by the passes' names.
export class Call {
    constructor(device, frame, call, codes) {
        this.device = device;
        this.extent = frame.extent;
        this.call = call;
        this.buffers = new Map();
        this.views = new Map();
        this.outputs = new Map();
        for (const binding of call.bindings) {
            this.createResource(frame, binding);
        }
        this.passes = call.passes.map((pass) => this.createPass(pass, codes.get(pass.file)));
    }

    createResource(frame, {name, binding, kind, bytes, file}) {
        if (kind === 'uniform' || kind === 'storage') {
            const usage = kind === 'uniform' ? GPUBufferUsage.UNIFORM : GPUBufferUsage.STORAGE | GPUBufferUsage.INDIRECT;
            const buffer = this.device.createBuffer({label: name, size: bytes, usage: usage | GPUBufferUsage.COPY_DST});
            if (file) {
                this.device.queue.writeBuffer(buffer, 0, frame.files.get(file));
            }
            this.buffers.set(binding, buffer);
        } else if (kind === 'output') {
            const texture = createTexture(this.device, this.call.expected[name].format, [...frame.extent, 1],
                                          GPUTextureUsage.STORAGE_BINDING | GPUTextureUsage.COPY_SRC);
            this.views.set(binding, texture.createView());
            this.outputs.set(name, texture);
        } else { // any image stands in for one that is not given
            const image = frame.images[name] ?? frame.images.depth;
            const dimension = name === 'shadowMaps' ? '2d-array' : '2d';
            this.views.set(binding, uploadImage(this.device, frame, image).createView({dimension}));
        }
    }

    createPass(pass, code) {
        const isAsked = ([name]) => code.includes(`override ${name}`);
        const constants = Object.fromEntries(
            Object.entries(this.call.constants).filter(isAsked).map(([name, value]) => [constantIds[name], value]));
        const {pipeline, layout, entries} = pipelineOf(this.device, pass.file, code, constants);
        const group = this.device.createBindGroup({
            layout,
            entries: entries.map(({binding, buffer}) => ({
                binding,
                resource: buffer ? {buffer: this.buffers.get(binding)} : this.views.get(binding),
            })),
        });
        return {pipeline, group, ...pass};
    }

    // Runs the passes one after the other; WebGPU puts the barriers between them.
    run() {
        const encoder = this.device.createCommandEncoder();
        const recorded = encoder.beginComputePass();
        for (const pass of this.passes) {
            recorded.setPipeline(pass.pipeline);
            recorded.setBindGroup(0, pass.group);
            if (pass.groups) {
                recorded.dispatchWorkgroups(...pass.groups);
            } else {
                recorded.dispatchWorkgroupsIndirect(this.buffers.get(pass.indirect.binding), pass.indirect.offset);
            }
        }
        recorded.end();
        this.device.queue.submit([encoder.finish()]);
    }

    // An output's values.
    async read(name) {
        const [width, height] = this.extent;
        const {format} = this.call.expected[name];
        const rowBytes = width * (format === 'r32float' ? 4 : 8);
        const bytesPerRow = Math.ceil(rowBytes / 256) * 256;
        const buffer = this.device.createBuffer({size: bytesPerRow * height, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST});
        const encoder = this.device.createCommandEncoder();
        encoder.copyTextureToBuffer({texture: this.outputs.get(name)}, {buffer, bytesPerRow}, [width, height]);
        this.device.queue.submit([encoder.finish()]);
        await buffer.mapAsync(GPUMapMode.READ);
        const rows = new Uint8Array(buffer.getMappedRange());
        const bytes = new Uint8Array(rowBytes * height);
        for (let y = 0; y < height; ++y) {
            bytes.set(rows.subarray(bytesPerRow * y, bytesPerRow * y + rowBytes), rowBytes * y);
        }
        buffer.unmap();
        return valuesOf(format, bytes.buffer);
    }
}

function halfToFloat(half) {
    const sign = half & 0x8000 ? -1 : 1;
    const exponent = (half >> 10) & 31;
    const mantissa = half & 1023;
    if (exponent === 31) {
        return mantissa ? NaN : sign * Infinity;
    }
    return sign * (exponent ? 2 ** (exponent - 15) * (1 + mantissa / 1024) : 2 ** -14 * (mantissa / 1024));
}

// The values of an image's bytes: four a pixel, or one.
export function valuesOf(format, bytes) {
    return format === 'r32float' ? new Float32Array(bytes) : Float32Array.from(new Uint16Array(bytes), halfToFloat);
}

// How far an image is from one that the library's own passes wrote: dB, peak 1, the largest error, and how many values are off
// by a hundredth, each over the pixels of which `counts` is true. Above 1 errors are relative. `channels`: of a pixel; a fourth is left out.
export function compare(image, expected, channels, counts) {
    let squares = 0;
    let values = 0;
    let largest = 0;
    let visible = 0; // values that are off by a hundredth
    for (let i = 0; i < image.length; ++i) {
        if (i % channels === 3 || !counts(Math.floor(i / channels))) {
            continue;
        }
        const same = Object.is(image[i], expected[i]);
        const error = same ? 0 : Math.abs(image[i] - expected[i]) / Math.max(1, Math.abs(expected[i]));
        largest = Math.max(largest, Number.isFinite(error) ? error : Infinity);
        visible += error > 0.01 ? 1 : 0;
        squares += error * error;
        values += 1;
    }
    return {psnr: -10 * Math.log10(Math.max(squares / Math.max(values, 1), 1e-20)), largest, visible, values};
}
