// What both pipelines of pass C of `bank` know of a region, in shared memory, the material's mixture of its kernels, and
// storing the result. bank_region.glsl, bank_combine.glsl. Included by them when they have defined
//   ownSide                 px: a thread combines a square of pixels with this side
//   levelSizes, levelStart  of a level from 2 on: the texels that a region's pixels read, and how many it reads before them
#include "bank.wgsl"

struct TilesToRead {
    dispatches: array<vec4u, 2>, // x, y, z, count
    entries: array<u32>,
}

@group(0) @binding(bindingTables)
var<storage, read> bankTables: array<vec4u>; // bankTableWords a material
@group(0) @binding(bindingIntermediates + intermediateBankReduced)
var<storage, read> reducedTexels: array<vec4u>;
@group(0) @binding(bindingIntermediates + intermediateBankBlurred)
var<storage, read> blurredLights: array<vec2u>;
@group(0) @binding(bindingIntermediates + intermediateBankBorrowed)
var<storage, read> borrowedSurfaces: array<vec2u>;
@group(0) @binding(bindingIntermediates + intermediateBankMaterials)
var<storage, read> quadMaterials: array<vec2u>;
@group(0) @binding(bindingIntermediates + intermediateBankTiles)
var<storage, read> tiles: TilesToRead;

const threads: i32 = 128;
const regionSize = ownSide * partSize; // px
const fineSize = regionSize / 2;       // texels of level 1
// Level 1 is loaded as reduced, with two texels around, for its 3x3 mean and to read that bilinearly.
const finePitch: i32 = fineSize.x + 4;
const fineCount: i32 = finePitch * (fineSize.y + 4);
const coarseCount: i32 = levelStart[bankLevels + 1];
const pixelPitch: i32 = regionSize.x + 2;
const pixelCount: i32 = pixelPitch * (regionSize.y + 2);

// The region's pixels with one around: light, and what weighs it, 0 where a pixel gives none.
var<workgroup> pixelLights: array<vec4f, pixelCount>;
// Of the levels from 2 on, level by level: light times coverage, and coverage.
var<workgroup> levelLights: array<vec4f, coarseCount>;
// Of the same texels' surfaces. Where none is near, depth is so far that it weighs nothing.
const farAway: f32 = 1e15;
var<workgroup> levelDepths: array<f32, coarseCount>;
var<workgroup> levelMaterials: array<u32, coarseCount>;
// Bit l: a texel of level l has steppedBit, and taps have depth weights of their own; else bilinear ones will do.
var<workgroup> steppedLevels: atomic<u32>;

// What this workgroup combines.
struct Region {
    first: vec2i,  // px of the render area
    skipped: u32,  // ListEntry
    occupied: u32, // ListEntry
    exists: bool,  // the last row of a list is not full
}

fn findRegion(kind: i32, group: vec3u) -> Region {
    let index = group.y * bankDispatchWidth + group.x;
    let dispatch = tiles.dispatches[kind];
    let place = listPlace(kind, min(index, listCapacity(kind) - 1u));
    let entry = unpackListEntry(tiles.entries[place], tiles.entries[place + 1]);
    // Without a count one row is the list.
    return Region(entry.part * partSize, entry.skipped, entry.occupied, index < max(dispatch.x, dispatch.w));
}

// The first texel of a level in shared memory: the one left of and above the region's first pixel.
fn levelFirst(level: i32, region: vec2i) -> vec2i {
    return (region - (1 << u32(level - 1))) >> vec2u(u32(level));
}

// Of a texel of level 1, counted from the region's first; at the border the nearest.
fn fineTexelIndex(region: Region, texel: vec2i) -> i32 {
    return texelIndex(1, clamp((region.first >> vec2u(1u)) + texel, vec2i(0), levelExtent(1) - 1));
}

// Whether the tile of a texel of level 1 holds subsurface pixels. In others pass A has written nothing of level 1.
fn isOccupied(region: Region, texel: vec2i) -> bool {
    let tile = (((region.first >> vec2u(1u)) + texel) >> vec2u(3u)) - (region.first >> vec2u(4u)) + 1;
    return (region.occupied & occupiedBit(tile)) != 0u;
}

fn fineWords(region: Region, texel: vec2i) -> vec4u {
    if (!isOccupied(region, texel)) {
        return vec4u(0u);
    }
    return reducedTexels[fineTexelIndex(region, texel)];
}

// Of level 1's texels in shared memory; counted from the region's first.
fn fineIndex(texel: vec2i) -> i32 {
    return (texel.y + 2) * finePitch + texel.x + 2;
}

// The texel of level 1 at a place in shared memory.
fn fineTexel(index: i32) -> vec2i {
    return vec2i(index % finePitch, index / finePitch) - 2;
}

// A pixel's place in shared memory, counted from the region's first.
fn pixelPlace(pixel: vec2i) -> i32 {
    return (pixel.y + 1) * pixelPitch + pixel.x + 1;
}

fn pixelAt(place: i32) -> vec2i {
    return vec2i(place % pixelPitch, place / pixelPitch) - 1;
}

// Of the four pixels of a texel of level 1, whose last word is `quad`; 16 bits each.
fn materialsOf(quad: u32, index: i32) -> vec2u {
    if (isMixed(quad)) {
        return quadMaterials[index];
    }
    return vec2u(materialOf(quad) * 0x10001u);
}

// A pixel's material, 0 outside the image. `place`: counted from the region's first pixel.
fn materialInRegion(region: Region, place: vec2i) -> u32 {
    let local = region.first + place;
    if (any(local < vec2i(0)) || any(local >= parameters.view.areaExtent)) {
        return 0u;
    }
    let texel = place >> vec2u(1u);
    return pixelMaterial(materialsOf(fineWords(region, texel).w, fineTexelIndex(region, texel)), local);
}

// The surface of a texel: its own or, where it is empty and light reaches it, the one it has borrowed. `own`: the last two of
// its words.
fn surfaceOf(index: i32, own: vec2u, light: vec2u) -> vec2u {
    if (isCovered(own.y) || all(light == vec2u(0u, steppedBit))) {
        return own;
    }
    let borrowed = borrowedSurfaces[blurredIndex(index)];
    return vec2u(borrowed.x, (borrowed.y << 16u) | fullCoverage);
}

// Loads the texels of the levels from 2 on. At the border the nearest, with bankBorderShare of its light and coverage beyond.
fn loadLevels(region: vec2i, thread: i32) {
    if (thread >= coarseCount) {
        return;
    }
    var level = 2;
    while (thread >= levelStart[level + 1]) {
        level++;
    }
    let number = thread - levelStart[level];
    let width = levelSizes[level].x;
    let texel = levelFirst(level, region) + vec2i(number % width, number / width);
    let inside = clamp(texel, vec2i(0), levelExtent(level) - 1);
    let index = texelIndex(level, inside);
    let words = blurredLights[blurredIndex(index)];
    let surface = surfaceOf(index, reducedTexels[index].zw, words);
    let light = unpackFour(vec2u(words.x, words.y & ~steppedBit));
    levelLights[thread] = light * select(bankBorderShare, 1.0, all(texel == inside));
    levelDepths[thread] = select(farAway, bitcast<f32>(surface.x), isCovered(surface.y));
    levelMaterials[thread] = materialOf(surface.y);
    if ((words.y & steppedBit) != 0u) {
        atomicOr(&steppedLevels, 1u << u32(level));
    }
}

// Where pixels lie between four texels of a level.
struct Corner {
    place: i32,      // in shared memory, of the texel up and left of them
    pitch: i32,      // to the texel below
    fraction: vec2f, // of their middle, towards the next texels
}

// `local`: counted from the region's first pixel.
fn cornerOf(level: i32, region: vec2i, local: vec2i) -> Corner {
    let width = 1 << u32(level);
    // In px from the middle of levelFirst on.
    let beyond = local + ((region + (width >> 1u)) & vec2i(width - 1));
    let texel = beyond >> vec2u(u32(level));
    let fraction = (vec2f(beyond & vec2i(width - 1)) + 0.5 * f32(ownSide)) / f32(width);
    let pitch = levelSizes[level].x;
    return Corner(levelStart[level] + texel.y * pitch + texel.x, pitch, fraction);
}

// What scales squared distances of a level for depthWeight.
fn levelScale(level: i32, depth: f32) -> f32 {
    return depthScale(texelWidth(level, depth), bankLevelDepthVariance);
}

// What a level's weighted taps are multiplied by: one over their total weight, times how much of the level is where the pixel
// is, [0, 1]. `away`: weighted sum of how far the taps are behind the pixel, mm. `scale`: levelScale.
fn levelFactor(total: f32, away: f32, scale: f32) -> f32 {
    let normalization = 1.0 / max(total, bankLeastWeight);
    return normalization * depthWeight(away * normalization, scale * (bankLevelDepthVariance / bankLevelAwayVariance));
}

// A material's weights of the kernels at a scale.
struct Mixture {
    first: u32,    // of the bin, in bankTables
    fraction: f32, // [0, 1] towards the next
    word: u32,     // the material's strength, and bits of the kernels that have a weight
}

// `pixel`: near where. A surface across the view direction is seen at the same scale everywhere. `scale`: scaleAt there.
fn findMixture(material: u32, depth: f32, pixel: vec2i, scale: f32) -> Mixture {
    let octave = -log2(texelWidth(0, depth / stretchAt(pixel)) / scale);
    let position = clamp(f32(bankBinsPerOctave) * (octave - f32(bankFirstOctave)), 0.0, f32(bankTableBins - 1u));
    let bin = min(u32(position), bankTableBins - 1u);
    let first = material * bankTableWords + bin * bankBinWords;
    return Mixture(first, position - f32(bin), bankTables[first].w);
}

fn isUsed(mixture: Mixture, kernel: i32) -> bool {
    return ((mixture.word >> u32(kernel)) & 1u) != 0u;
}

fn strengthOf(mixture: Mixture) -> f32 {
    return bitcast<f32>(mixture.word & ~0xffu);
}

// Red, green and blue.
fn kernelWeight(mixture: Mixture, kernel: i32) -> vec3f {
    let words = bankTables[mixture.first + u32(kernel)];
    let blue = unpack2x16float(words.z);
    return mix(vec3f(unpack2x16float(words.x), blue.x), vec3f(unpack2x16float(words.y), blue.y), mixture.fraction);
}
