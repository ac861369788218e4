// Pass C of `bank` for regions with depth discontinuities, 16x8 px, one a thread, or where materials are separate: the same
// mixture as the smooth pipeline's, with depth weights tap by tap where surfaces meet. docs/scatter.md.
#include "bank_region.wgsl"

@group(0) @binding(bindingIntermediates + intermediateBankAreas)
var<storage, read> quadAreas: array<u32>;

const ownSide: i32 = 1;
const levelSizes = array<vec2i, 7>(vec2i(0, 0), vec2i(0, 0), vec2i(6, 4), vec2i(4, 3), vec2i(3, 2), vec2i(2, 2), vec2i(2, 2));
const levelStart = array<i32, 8>(0, 0, 0, 24, 36, 42, 46, 50);

// Of pixelLights' pixels: depth, 0 where there is none, and material.
var<workgroup> pixelDepths: array<f32, pixelCount>;
var<workgroup> pixelMaterials: array<u32, pixelCount>;

// A texel of level 1 as reduced.
struct FineTap {
    lightAndArea: vec4f, // light times area, and area, 0 where it is empty
    depth: f32,
    scale: f32,          // of squared distances in texel widths, for depthWeight
    lightSlope: f32,     // DepthSpread
    material: u32,
}
var<workgroup> fineTaps: array<FineTap, fineCount>;
const pixelScale: f32 = 0.25 / bankPixelDepthVariance;

fn loadFine(region: Region, index: i32) {
    let words = fineWords(region, fineTexel(index));
    let spread = spreadOf(words.zw);
    let lightAndArea = unpackFour(words.xy);
    // What is spread over more depths weighs farther, and less.
    let area = abs(lightAndArea.a) * sqrt(sqrt(spread.closeness));
    fineTaps[index] = FineTap(vec4f(lightAndArea.rgb, 1.0) * area, abs(bitcast<f32>(words.z)),
                              pixelScale * spread.closeness, spread.lightSlope, materialOf(words.w));
}

// The area of a pixel's surface, relative to one that faces the camera.
fn pixelArea(region: Region, place: vec2i, local: vec2i) -> f32 {
    let texel = place >> vec2u(1u);
    let words = fineWords(region, texel);
    if ((words.y & areasBit) == 0u) {
        return unpack2x16float(words.y).y;
    }
    return unpackArea(quadAreas[fineTexelIndex(region, texel)], u32((local.x & 1) + 2 * (local.y & 1)));
}

fn loadPixel(region: Region, place: i32) {
    let pixel = pixelAt(place);
    let material = materialInRegion(region, pixel);
    let local = clamp(region.first + pixel, vec2i(0), parameters.view.areaExtent - 1);
    let depth = distanceAlongRay(local + parameters.view.areaOffset);
    let light = enteringLight(local + parameters.view.areaOffset, material);
    let receives = material != 0u && depth > 0.0;
    // As half floats, in which the other pipeline's light is.
    let lightAndArea = vec4f(storableLight(light), pixelArea(region, pixel, local));
    pixelLights[place] = select(vec4f(0.0), lightAndArea, receives && isFiniteVector(light));
    pixelDepths[place] = select(0.0, depth, receives);
    pixelMaterials[place] = material;
}

fn loadRegion(region: Region, thread: i32) {
    for (var place = thread; place < pixelCount; place += threads) {
        loadPixel(region, place);
    }
    for (var index = thread; index < fineCount; index += threads) {
        loadFine(region, index);
    }
    loadLevels(region.first, thread);
}

// Whether a tap's light may leave the pixel. Asked only where some may not.
fn mayLeave(tap: u32, material: u32) -> bool {
    return !separateMaterials || exchanges(tap, material);
}

// Light times coverage, and coverage, from light and area that were summed with depth weights over the surface within a
// kernel's reach.
fn surfaceSeen(lightAndArea: vec4f) -> vec4f {
    let coverage = coverageOf(lightAndArea.a);
    return vec4f(lightAndArea.rgb * (coverage / max(lightAndArea.a, bankLeastWeight)), coverage);
}

// A pixel that is combined.
struct Receiver {
    local: vec2i, // counted from the region's first pixel
    depth: f32,
    material: u32,
}

// The full-resolution 3x3.
fn seePixels(pixel: Receiver) -> vec4f {
    const taps = array<f32, 3>(0.25, 0.5, 0.25);
    let scale = depthScale(texelWidth(0, pixel.depth), bankPixelDepthVariance);
    var lightAndArea = vec4f(0.0);
    for (var i = 0; i < 9; i++) {
        let place = pixelPlace(pixel.local + vec2i(i % 3, i / 3) - 1);
        if (mayLeave(pixelMaterials[place], pixel.material)) {
            let tap = pixelLights[place];
            let weight = taps[i % 3] * taps[i / 3] * depthWeight(pixelDepths[place] - pixel.depth, scale) * tap.a;
            lightAndArea += weight * vec4f(tap.rgb, 1.0);
        }
    }
    return surfaceSeen(lightAndArea);
}

// Level 1. Along an axis the 3x3 mean and the bilinear reading of it are one kernel of four texels, for a pixel in the second
// row or column of a quad from the texel before its own on; for one in the first its mirror image. A texel gives the light that
// it has at the pixel's depth, but at most bankMostLit times its mean.
fn seeFinestLevel(pixel: Receiver) -> vec4f {
    const taps = array<f32, 4>(3.0 / 12.0, 4.0 / 12.0, 4.0 / 12.0, 1.0 / 12.0);
    let width = texelWidth(1, pixel.depth);
    let next = 2 * (pixel.local & vec2i(1)) - 1; // which way the kernel goes
    let first = (pixel.local >> vec2u(1u)) - next;
    var lightAndArea = vec4f(0.0);
    for (var i = 0; i < 16; i++) {
        let tap = fineTaps[fineIndex(first + next * vec2i(i % 4, i / 4))];
        if (mayLeave(tap.material, pixel.material)) {
            let distance = (tap.depth - pixel.depth) / width;
            let weight = taps[i % 4] * taps[i / 4] * depthWeight(distance, tap.scale);
            let lit = clamp(1.0 - tap.lightSlope * distance, 0.0, bankMostLit);
            lightAndArea += weight * vec4f(vec3f(lit), 1.0) * tap.lightAndArea;
        }
    }
    return surfaceSeen(lightAndArea);
}

// A level from 2 on: light times coverage, and coverage.
struct Seen {
    light: vec4f,
    present: f32, // how much of it is where the pixel is, [0, 1]
}

// With depth weights only where `stepped`; else with bilinear ones.
fn seeLevel(level: i32, corner: Corner, pixel: Receiver, stepped: bool) -> Seen {
    let scale = levelScale(level, pixel.depth);
    var light = vec4f(0.0);
    var total = 0.0;
    var away = 0.0; // mm, how far the taps are behind the pixel
    for (var i = 0; i < 4; i++) {
        let place = corner.place + (i & 1) + (i >> 1u) * corner.pitch;
        let share = select(1.0 - corner.fraction, corner.fraction, vec2<bool>((i & 1) != 0, i > 1));
        let distance = levelDepths[place] - pixel.depth;
        var weight = share.x * share.y;
        if (stepped) {
            weight *= select(0.0, depthWeight(distance, scale), mayLeave(levelMaterials[place], pixel.material));
        }
        light += weight * levelLights[place];
        total += weight;
        away += weight * distance;
    }
    if (!stepped) {
        return Seen(light, 1.0);
    }
    let factor = levelFactor(total, away, scale);
    return Seen(light * factor, factor * total);
}

// From the coarsest level on: the weight of what of a level is not where the pixel is passes to the next finer one.
fn combine(mixture: Mixture, region: vec2i, pixel: Receiver) -> vec3f {
    let stepped = select(atomicLoad(&steppedLevels), ~0u, separateMaterials);
    var light = vec3f(0.0);
    var total = vec3f(0.0);
    var passedOn = vec3f(0.0);
    for (var level = bankLevels; level >= 2; level--) {
        if (isUsed(mixture, level + 1)) {
            let corner = cornerOf(level, region, pixel.local);
            let seen = seeLevel(level, corner, pixel, ((stepped >> u32(level)) & 1u) != 0u);
            let weight = kernelWeight(mixture, level + 1) + passedOn;
            light += weight * seen.light.rgb;
            total += weight * seen.light.a;
            passedOn = weight * (1.0 - seen.present);
        }
    }
    if (isUsed(mixture, 2)) {
        let seen = seeFinestLevel(pixel);
        let weight = kernelWeight(mixture, 2) + passedOn;
        light += weight * seen.rgb;
        total += weight * seen.a;
        passedOn = vec3f(0.0);
    }
    let seen = seePixels(pixel);
    let weight = kernelWeight(mixture, 1) + passedOn;
    let own = pixelLights[pixelPlace(pixel.local)];
    let identity = max(kernelWeight(mixture, 0), vec3f(bankLeastIdentity)) * coverageOf(own.a);
    return (light + weight * seen.rgb + identity * own.rgb) / max(total + weight * seen.a + identity, vec3f(1e-20));
}

@compute @workgroup_size(16, 8)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) invocation: vec3u,
        @builtin(local_invocation_index) index: u32) {
    let region = findRegion(1, group);
    if (region.exists) {
        loadRegion(region, i32(index));
    }
    workgroupBarrier();
    let local = vec2i(invocation.xy);
    if (!region.exists || any(region.first + local >= parameters.view.areaExtent)) {
        return;
    }
    let pixel = region.first + local + parameters.view.areaOffset;
    let place = pixelPlace(local);
    let receiver = Receiver(local, pixelDepths[place], pixelMaterials[place]);
    if (receiver.depth > 0.0) {
        let mixture = findMixture(receiver.material, receiver.depth, pixel, scaleAt(pixel));
        writeScattered(pixel, receiver.material, combine(mixture, region.first, receiver), strengthOf(mixture));
    } else {
        writeUnscattered(pixel, receiver.material);
    }
}
