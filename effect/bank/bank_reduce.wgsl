// Pass A of `bank`: levels 1 to 4 of the pyramid, a tile of 16x16 px a workgroup, 2x2 px a thread; notes which tiles hold
// subsurface pixels, and copies the tiles that hold none. docs/scatter.md.
#include "bank.wgsl"
#include "bank_reduction.wgsl"

struct TilesToWrite {
    dispatches: array<BankDispatch, 2>, // of the combination: smooth regions, edge regions
    entries: array<u32>,
}

struct BankDispatch {
    x: u32,
    y: u32,
    z: u32,
    count: u32,
}

@group(0) @binding(bindingIntermediates + intermediateBankReduced)
var<storage, read_write> reducedTexels: array<vec4u>;
@group(0) @binding(bindingIntermediates + intermediateBankMaterials)
var<storage, read_write> quadMaterials: array<vec2u>;
@group(0) @binding(bindingIntermediates + intermediateBankAreas)
var<storage, read_write> quadAreas: array<u32>;
@group(0) @binding(bindingIntermediates + intermediateBankTiles)
var<storage, read_write> tiles: TilesToWrite;

const side: i32 = tileSize / 2; // texels of level 1
const pitch: i32 = tileSize + 2;

// Level 1; each coarser level then stands at its first child's place.
var<workgroup> texels: array<ReducedTexel, side * side>;
// Of the tile's pixels and one around, mm; 0 where none receives light.
var<workgroup> depths: array<f32, pitch * pitch>;
var<workgroup> tileBits: atomic<u32>; // tileOccupied, tileStepBit of the tile's quads, tileBright
var<workgroup> knownBits: u32;

#include "bank_quad.wgsl"

// The tile's bits, the same for all threads. Two barriers.
fn bitsOfAll(thread: i32) -> u32 {
    workgroupBarrier();
    if (thread == 0) {
        knownBits = atomicLoad(&tileBits);
    }
    return workgroupUniformLoad(&knownBits);
}

fn storeQuad(reduced: ReducedQuad, material: vec4u, texel: vec2i) {
    let index = texelIndex(1, texel);
    let own = vec2u(material.x | (material.y << 16u), material.z | (material.w << 16u));
    let mixed = any(own != vec2u((own.x & 0xffffu) * 0x10001u));
    var words = packReduced(reduced.texel);
    words.w = reduced.weights & ~spreadBit;
    words.z |= reduced.weights & spreadBit;
    if (mixed) {
        quadMaterials[index] = own;
        words.w |= mixedBit | select(0u, reduced.texel.material << 16u, separateMaterials);
    } else {
        words.w |= own.x << 16u;
    }
    if (!reduced.shareArea) {
        quadAreas[index] = packAreas(reduced.areas);
        words.y |= areasBit;
    }
    reducedTexels[index] = words;
}

// Makes a texel of a level from 2 on, if this thread has one.
fn reduceLevel(level: i32, tile: vec2i, thread: i32) {
    let shift = u32(tileLevels - level); // of the level's texels a side in a tile
    if ((thread >> (2u * shift)) != 0) {
        return;
    }
    let texel = vec2i(thread & ((1 << shift) - 1), thread >> shift);
    let spacing = 1 << u32(level - 2);
    let first = (texel.y * side + texel.x) * 2 * spacing;
    let reduced = reduceTexels(array<ReducedTexel, 4>(texels[first], texels[first + spacing], texels[first + side * spacing],
                                                      texels[first + (side + 1) * spacing]), level);
    texels[first] = reduced;
    reducedTexels[texelIndex(level, (tile << vec2u(shift)) + texel)] = packReduced(reduced);
}

// The light of a tile without subsurface pixels leaves where it enters.
fn copyQuad(first: vec2i) {
    for (var i = 0; i < 4; i++) {
        let local = first + offsetOf(i);
        if (isInExtent(local)) {
            writeUnscattered(local + parameters.view.areaOffset, 0u);
        }
    }
}

// The pyramid is empty there. Of level 1 nothing is written: pass C knows which tiles are empty.
fn clearTile(tile: vec2i, thread: i32) {
    for (var level = 2; level <= tileLevels; level++) {
        let shift = u32(tileLevels - level);
        if ((thread >> (2u * shift)) == 0) {
            let texel = vec2i(thread & ((1 << shift) - 1), thread >> shift);
            reducedTexels[texelIndex(level, (tile << vec2u(shift)) + texel)] = vec4u(0u);
        }
    }
}

// The pixels around the tile, without its corners: one a thread, counted from the tile's first.
fn ringPlace(thread: i32) -> vec2i {
    let along = thread & (tileSize - 1);
    let beyond = select(tileSize, -1, (thread & tileSize) == 0);
    return select(vec2i(beyond, along), vec2i(along, beyond), thread < 2 * tileSize);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) invocation: vec3u,
        @builtin(local_invocation_index) index: u32) {
    let thread = i32(index);
    let tile = vec2i(group.xy);
    let texel = vec2i(invocation.xy);
    let tileFirst = tile * tileSize;
    let first = tileFirst + 2 * texel;
    if (thread == 0 && all(tile == vec2i(0))) {
        tiles.dispatches[0] = BankDispatch(0u, 1u, 1u, 0u);
        tiles.dispatches[1] = BankDispatch(0u, 1u, 1u, 0u);
    }
    let ids = vec4u(idAt(first), idAt(first + vec2i(1, 0)), idAt(first + vec2i(0, 1)), idAt(first + 1));
    if (any(ids != vec4u(0u))) {
        atomicOr(&tileBits, tileOccupied);
    }
    if (bitsOfAll(thread) == 0u) {
        if (thread == 0) {
            tiles.entries[tileIndex(tile)] = 0u;
        }
        copyQuad(first);
        clearTile(tile, thread);
        return;
    }
    let quad = fetchQuad(first, ids);
    let place = depthPlace(2 * texel);
    for (var i = 0; i < 4; i++) {
        depths[place + (i & 1) + (i >> 1u) * pitch] = quad.depth[i];
    }
    let ring = ringPlace(thread);
    depths[depthPlace(ring)] = receivingDepth(tileFirst + ring, idAt(tileFirst + ring));
    workgroupBarrier();
    let reduced = reduceQuad(quad, place);
    storeQuad(reduced, quad.material, tile * side + texel);
    texels[texel.y * side + texel.x] = reduced.texel;
    if ((reduced.weights & spreadBit) != 0u) {
        atomicOr(&tileBits, tileStepBit(texel));
    }
    let bits = bitsOfAll(thread);
    if (thread == 0) {
        tiles.entries[tileIndex(tile)] = bits;
    }
    for (var level = 2; level <= tileLevels; level++) {
        reduceLevel(level, tile, thread);
        workgroupBarrier();
    }
}
