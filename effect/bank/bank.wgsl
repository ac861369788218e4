// What the passes of `bank` have in common: what lies where in the buffers between them, and depth weights. bank.glsl, but for
// second surfaces and half floats.
#include "interface/scatter.wgsl"
#include "bank_blocks.h"
#include "bank_constants.h"
#include "bank_texel.wgsl"

@id(0) override separateMaterials: bool = false; // some do not exchange light with some others

const tileSize: i32 = 16;             // px, of pass A
const partSize = vec2i(16, 8);        // px, of an edge region; a smooth one is 2x2 of these
const tileLevels: i32 = 4;            // levels 5 and 6 are reduced by the blur

// Light as half floats may have it, where it enters.
fn storableLight(light: vec3f) -> vec3f {
    return clamp(light, vec3f(0.0), vec3f(maxHalf));
}

fn offsetOf(i: i32) -> vec2i {
    return vec2i(i & 1, i >> 1u);
}

fn levelExtent(level: i32) -> vec2i {
    return parameters.bankLevels[level].yz;
}

fn isInLevel(level: i32, texel: vec2i) -> bool {
    return all(texel >= vec2i(0)) && all(texel < levelExtent(level));
}

fn texelIndex(level: i32, texel: vec2i) -> i32 {
    let place = parameters.bankLevels[level];
    return place.x + texel.y * place.y + texel.x;
}

// Of a texel of the levels that are blurred, whose place in the whole pyramid `index` is.
fn blurredIndex(index: i32) -> i32 {
    return index - parameters.bankLevels[2].x;
}

fn tileIndex(tile: vec2i) -> i32 {
    return tile.y * levelExtent(tileLevels).x + tile.x;
}

// Smooth regions, of 32x16 px, two tiles side by side.
fn regionCount() -> vec2i {
    return levelExtent(tileLevels) / vec2i(2, 1);
}

// The most regions that a list of smooth (0) or edge regions (1) may have.
fn listCapacity(kind: i32) -> u32 {
    let regions = regionCount();
    return u32(regions.x * regions.y) * select(4u, 1u, kind == 0);
}

// Where an entry of a list is among the tiles' entries.
fn listPlace(kind: i32, entry: u32) -> i32 {
    let regions = regionCount();
    return (2 + 2 * kind) * regions.x * regions.y + 2 * i32(entry);
}

// A region on a list.
struct ListEntry {
    part: vec2i,   // its first
    skipped: u32,  // of a smooth one: bits of the parts that it leaves out
    occupied: u32, // occupiedBit of the tiles that it reads and that have tileOccupied; tileBright, if one of them has it
}

// Of a tile that lies so far from the one left of and above the region's first.
fn occupiedBit(tile: vec2i) -> u32 {
    return 1u << u32(4 * tile.y + tile.x);
}

// The tiles around the one of an edge region.
const edgeReads: u32 = 0x777u;

fn packPart(entry: ListEntry) -> u32 {
    return u32(entry.part.x) | (u32(entry.part.y) << 12u) | (entry.skipped << 24u);
}

fn unpackListEntry(part: u32, occupied: u32) -> ListEntry {
    return ListEntry(vec2i(vec2u(part, part >> 12u) & vec2u(0xfffu)), part >> 24u, occupied);
}

// A tile's entry: tileOccupied, tileStepBit of its quads, tileBright (bank.glsl).
const tileOccupied: u32 = 1u;
const tileBright: u32 = 1u << 19u;
const tileRowGroups: u32 = 0x54432110u; // a hexadecimal digit a row, the first one last

fn tileStepBit(quad: vec2i) -> u32 {
    let row = (tileRowGroups >> u32(4 * quad.y)) & 7u;
    let column = select(0u, 1u, quad.x > 0) + select(0u, 1u, quad.x == 7);
    return 2u << (3u * row + column);
}

const mostDimLight: f32 = 0.5 * maxHalf;

// Position of one of the places around a rectangle, counted row above, row below, then the sides.
fn ringPosition(index: i32, size: vec2i) -> vec2i {
    let width = size.x + 2;
    if (index < width) {
        return vec2i(index - 1, -1);
    }
    if (index < 2 * width) {
        return vec2i(index - width - 1, size.y);
    }
    let side = index - 2 * width;
    return vec2i(select(size.x, -1, (side & 1) == 0), side >> 1u);
}

// Width of a texel in mm, where the surface faces the camera. Level 0 are the pixels.
fn texelWidth(level: i32, depth: f32) -> f32 {
    return f32(1 << u32(level)) * parameters.pixelWidth * clipW(parameters.view.distanceOrigin - depth);
}

// e^−q, near enough, and 0 from q = 4 on.
fn falloff(q: f32) -> f32 {
    let base = clamp(1.0 - 0.25 * q, 0.0, 1.0);
    return base * base * base * base;
}

// The same of a distance's square over that of a width times a variance. `scale`: depthScale, of these two.
fn depthWeight(distance: f32, scale: f32) -> f32 {
    return falloff(4.0 * distance * distance * scale);
}

fn depthScale(width: f32, variance: f32) -> f32 {
    return 0.25 / (variance * width * width);
}

// What a kernel's share of a pixel is multiplied by, from the surface within its reach.
fn coverageOf(area: f32) -> f32 {
    return min(area, 1.0);
}
