// Pass B of `bank`: blurs the levels from 2 on along the surface with a 5x5 binomial, 16x8 texels a workgroup, of the
// coarsest level 6x2, at most one a thread; all levels in one dispatch, coarsest first; lists the regions that hold
// subsurface pixels for pass C. docs/scatter.md.
#include "bank.wgsl"
#include "bank_reduction.wgsl"

struct TilesToList {
    dispatches: array<AtomicDispatch, 2>,
    entries: array<u32>,
}

struct AtomicDispatch {
    x: atomic<u32>,
    y: atomic<u32>,
    z: atomic<u32>,
    count: atomic<u32>,
}

@group(0) @binding(bindingIntermediates + intermediateBankReduced)
var<storage, read_write> reducedTexels: array<vec4u>;
@group(0) @binding(bindingIntermediates + intermediateBankBlurred)
var<storage, read_write> blurredLights: array<vec2u>;
@group(0) @binding(bindingIntermediates + intermediateBankBorrowed)
var<storage, read_write> borrowedSurfaces: array<vec2u>;
@group(0) @binding(bindingIntermediates + intermediateBankTiles)
var<storage, read_write> tiles: TilesToList;

const threads: i32 = 128;
const blockSize = vec2i(16, 8);
// Of the coarsest level, whose texels are reduced twice: as many as have their children in the room of a block of the level
// before.
const coarsestSize = vec2i(6, 2);
const reach: i32 = 2; // of the kernels, texels
const pitch: i32 = blockSize.x + 2 * reach;
const loadedCount: i32 = pitch * (blockSize.y + 2 * reach);

// The block's texels with those that its kernels reach, in the words of packReduced.
var<workgroup> loaded: array<vec4u, loadedCount>;
var<workgroup> blockBits: atomic<u32>; // bits of the block, as below
var<workgroup> knownBits: u32;

#include "bank_lists.wgsl"

struct Block {
    level: i32,
    first: vec2i, // texel
    size: vec2i,
}

// The levels' blocks, counted from the coarsest level on.
fn findBlock(group: i32) -> Block {
    var level = 2;
    for (var finer = 2; finer < bankLevels; finer++) {
        level += select(0, 1, group < parameters.bankLevels[finer].w);
    }
    let place = parameters.bankLevels[level];
    let size = select(blockSize, coarsestSize, level == bankLevels);
    let index = group - place.w;
    let width = (place.y + size.x - 1) / size.x;
    return Block(level, vec2i(index % width, index / width) * size, size);
}

// Bits of a block: texels with a step beside them or pixels left out; texels that are not fully covered; any that are
// covered at all. A block with the last one alone is unbroken.
const anyStep: u32 = 1u;
const notFull: u32 = 2u;
const anything: u32 = 4u;

// The block's bits, the same for all threads. Two barriers.
fn bitsOfAll(thread: i32) -> u32 {
    workgroupBarrier();
    if (thread == 0) {
        knownBits = atomicLoad(&blockBits);
    }
    return workgroupUniformLoad(&knownBits);
}

fn placeInBlock(index: i32) -> vec2i {
    return vec2i(index % pitch, index / pitch);
}

fn sharedIndex(place: vec2i) -> i32 {
    return place.y * pitch + place.x;
}

fn depthAt(index: i32) -> f32 {
    return bitcast<f32>(loaded[index].z);
}

// A texel's words; those of an empty one outside the level.
fn reducedWords(level: i32, texel: vec2i) -> vec4u {
    if (!isInLevel(level, texel)) {
        return vec4u(0u);
    }
    return reducedTexels[texelIndex(level, texel)];
}

// A texel of a level that pass A leaves to this one.
fn reduceWords(level: i32, texel: vec2i) -> vec4u {
    if (!isInLevel(level, texel)) {
        return vec4u(0u);
    }
    var children: array<ReducedTexel, 4>;
    for (var i = 0; i < 4; i++) {
        children[i] = unpackReduced(reducedWords(level - 1, 2 * texel + offsetOf(i)));
    }
    return packReduced(reduceTexels(children, level));
}

// In shared memory, and of a block's own texels for pass C, if this pass has made them.
fn keep(block: Block, place: vec2i, words: vec4u) {
    loaded[sharedIndex(place)] = words;
    let texel = block.first - reach + place;
    let last = min(block.first + block.size, levelExtent(block.level));
    if (block.level > tileLevels && all(texel >= block.first) && all(texel < last)) {
        reducedTexels[texelIndex(block.level, texel)] = words;
    }
    let bits = select(notFull, 0u, isFullyCovered(words.w)) | select(0u, anyStep, isDropped(words.w)) |
               select(0u, anything, words.z != 0u);
    if (bits != 0u) {
        atomicOr(&blockBits, bits);
    }
}

// The texels of pass A as they are, those of the level after its own reduced.
fn loadBlock(block: Block, thread: i32) {
    for (var index = thread; index < loadedCount; index += threads) {
        let place = placeInBlock(index);
        let texel = block.first - reach + place;
        if (block.level <= tileLevels) {
            keep(block, place, reducedWords(block.level, texel));
        } else {
            keep(block, place, reduceWords(block.level, texel));
        }
    }
}

// The coarsest level's, for which those of the level before are reduced first. Two barriers.
fn loadCoarsestBlock(block: Block, thread: i32) {
    for (var index = thread; index < loadedCount; index += threads) {
        let place = placeInBlock(index);
        loaded[index] = reduceWords(bankLevels - 1, 2 * (block.first - reach) + place);
    }
    workgroupBarrier();
    const size = coarsestSize + 2 * reach;
    let place = vec2i(thread % size.x, thread / size.x);
    var words = vec4u(0u);
    if (place.y < size.y && isInLevel(bankLevels, block.first - reach + place)) {
        var children: array<ReducedTexel, 4>;
        for (var i = 0; i < 4; i++) {
            children[i] = unpackReduced(loaded[sharedIndex(2 * place + offsetOf(i))]);
        }
        words = packReduced(reduceTexels(children, bankLevels));
    }
    workgroupBarrier();
    if (place.y < size.y) {
        keep(block, place, words);
    }
}

// Whether two texels are surfaces further from each other than a smooth one's neighbours would be.
fn isStep(a: f32, b: f32, limit: f32) -> bool {
    return min(a, b) > 0.0 && abs(a - b) > limit;
}

// Notes steps beside the texels that are loaded, right and below: between 2x2 of them by the farthest one's width.
fn noteSteps(block: Block, thread: i32) {
    let last = block.size + 2 * reach - 1;
    const pairs = pitch / 2;
    let first = 2 * vec2i(thread % pairs, thread / pairs);
    if (any(first > last)) {
        return;
    }
    var around: array<f32, 9>;
    for (var i = 0; i < 9; i++) {
        around[i] = depthAt(sharedIndex(min(first + vec2i(i % 3, i / 3), last)));
    }
    let farthest = max(max(around[0], around[1]), max(around[3], around[4]));
    let limit = bankSmoothDepth * texelWidth(block.level, farthest);
    for (var i = 0; i < 4; i++) {
        let own = around[i % 2 + i / 2 * 3];
        if (isStep(own, around[i % 2 + i / 2 * 3 + 1], limit) || isStep(own, around[i % 2 + i / 2 * 3 + 3], limit)) {
            atomicOr(&blockBits, anyStep);
        }
    }
}

// Where a texel's kernel stands: its own surface or, where it is empty, its neighbours', so that light reaches across
// small holes.
fn findSurface(level: i32, center: i32) -> BlurredTexel {
    let own = unpackReduced(loaded[center]);
    var result = BlurredTexel(vec3f(0.0), 0.0, own.depth, own.material, own.coverage > 0.0, own.dropped);
    if (!result.present) {
        var coverage = 0.0;
        var heaviest = 0.0;
        for (var i = 0; i < 9; i++) {
            let tap = unpackReduced(loaded[center + i % 3 - 1 + (i / 3 - 1) * pitch]);
            coverage += tap.coverage;
            result.depth += tap.coverage * tap.depth;
            if (tap.coverage > heaviest) {
                heaviest = tap.coverage;
                result.material = tap.material;
            }
        }
        result.present = coverage > 0.0;
        result.depth /= max(coverage, 1e-20);
    }
    let limit = bankSmoothDepth * texelWidth(level, result.depth);
    const beside = array<i32, 4>(-1, 1, -pitch, pitch);
    for (var i = 0; i < 4; i++) {
        let tap = depthAt(center + beside[i]);
        result.stepped = result.stepped || (tap != 0.0 && abs(tap - result.depth) > limit);
    }
    return result;
}

// Blurs along a surface: light and area of what the kernel reaches.
fn blurAlong(surface: BlurredTexel, level: i32, center: i32) -> vec4f {
    const taps = array<f32, 5>(1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0);
    let scale = depthScale(texelWidth(level, surface.depth), bankBlurDepthVariance);
    var sum = vec4f(0.0);
    for (var y = 0; y < 5; y++) {
        for (var x = 0; x < 5; x++) {
            let words = loaded[center + x - 2 + (y - 2) * pitch];
            if (separateMaterials && !exchanges(materialOf(words.w), surface.material)) {
                continue;
            }
            let tap = unpackFour(words.xy); // an empty texel has no area
            let distance = bitcast<f32>(words.z) - surface.depth;
            sum += taps[x] * taps[y] * depthWeight(distance, scale) * tap.a * vec4f(tap.rgb, 1.0);
        }
    }
    return sum;
}

// `unbroken`: every tap is full and no step is near, so that nothing is missing and nothing left out.
fn blurTexel(level: i32, center: i32, unbroken: bool) -> BlurredTexel {
    var texel = findSurface(level, center);
    let sum = blurAlong(texel, level, center);
    if (unbroken) {
        texel.coverage = 1.0;
        texel.stepped = false;
        texel.light = sum.rgb / sum.a;
    } else {
        texel.coverage = unpack2x16float(pack2x16float(vec2f(coverageOf(sum.a), 0.0))).x; // as it is stored
        texel.light = sum.rgb * (texel.coverage / max(sum.a, bankLeastWeight));
    }
    return texel;
}

@compute @workgroup_size(16, 8)
fn main(@builtin(workgroup_id) id: vec3u, @builtin(local_invocation_id) invocation: vec3u,
        @builtin(local_invocation_index) index: u32) {
    let thread = i32(index);
    let group = i32(id.y * bankDispatchWidth + id.x);
    if (group < parameters.bankLevels[bankLevels].w) {
        listRegions(group, thread);
        return;
    }
    let block = findBlock(group);
    if (block.level == bankLevels) {
        loadCoarsestBlock(block, thread);
    } else {
        loadBlock(block, thread);
    }
    workgroupBarrier();
    noteSteps(block, thread);
    let unbroken = bitsOfAll(thread) == anything && !separateMaterials;
    let local = vec2i(invocation.xy);
    let texel = block.first + local;
    if (any(local >= block.size) || !isInLevel(block.level, texel)) {
        return;
    }
    let center = sharedIndex(local + reach);
    let blurred = blurTexel(block.level, center, unbroken);
    let place = blurredIndex(texelIndex(block.level, texel));
    blurredLights[place] = packBlurred(blurred);
    if (depthAt(center) == 0.0 && blurred.present) {
        borrowedSurfaces[place] = vec2u(bitcast<u32>(blurred.depth), blurred.material);
    }
}
