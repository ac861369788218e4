// What the three passes of `bank` have in common: the buffers between them and what lies where in these, and depth weights.
// SECOND_SURFACES may be defined: `bank-surfaces`.
#include "interface/scatter.glsl"
#include "bank_blocks.h"
#include "bank_constants.h"

// How a pass uses the buffers between passes; pass C says that it only reads them.
#ifndef BANK_ACCESS
#define BANK_ACCESS
#endif

layout(constant_id = 0) const bool separateMaterials = false; // some do not exchange light with some others

layout(set = 0, binding = bindingIntermediates + intermediateBankReduced, std430) BANK_ACCESS buffer BankReduced {
    uvec4 reducedTexels[]; // levels 1 … 6; what is not written of level 1 lies in tiles without tileOccupied
};
layout(set = 0, binding = bindingIntermediates + intermediateBankBlurred, std430) BANK_ACCESS buffer BankBlurred {
    uvec2 blurredLights[]; // levels 2 … 6 (blurredIndex): packed as bank_texel.glsl says
};
layout(set = 0, binding = bindingIntermediates + intermediateBankBorrowed, std430) BANK_ACCESS buffer BankSurfaces {
    // Of the same texels: depth and material that an empty texel's kernel stands on. One that is not empty has both itself.
    uvec2 borrowedSurfaces[];
};
layout(set = 0, binding = bindingIntermediates + intermediateBankMaterials, std430) BANK_ACCESS buffer BankMaterials {
    uvec2 quadMaterials[]; // as level 1 lies: of the four pixels, only where they differ
};
layout(set = 0, binding = bindingIntermediates + intermediateBankAreas, std430) BANK_ACCESS buffer BankAreas {
    uint quadAreas[]; // as level 1 lies: packAreas of the four pixels, only where they do not share their area
};
layout(set = 0, binding = bindingIntermediates + intermediateBankSeconds, std430) BANK_ACCESS buffer BankSeconds {
    // Levels 1 … secondLevels, as reducedTexels: only where a texel has a second surface (secondBit). Then, from level 2 on
    // (blurredSecondIndex), the same surfaces blurred: light and coverage as in blurredLights, depth.
    uvec4 secondTexels[];
};
layout(set = 0, binding = bindingIntermediates + intermediateBankTiles, std430) BANK_ACCESS buffer BankTiles {
    BankDispatch dispatches[2]; // of the combination: smooth regions, edge regions
    // Per tile: tileOccupied, tileStepBit; then the lists of smooth regions and of edge regions, two words each (ListEntry).
    uint tileEntries[];
};

// Levels up to this one keep two surfaces. Where materials are separate, they keep one.
#ifdef SECOND_SURFACES
const int secondLevels = separateMaterials ? 0 : bankSecondLevels;
#else
const int secondLevels = 0;
#endif
const int tileSize = 16; // px, of pass A; level l has tileSize / 2^l texels a side in each tile
const ivec2 partSize = ivec2(16, 8); // px, of an edge region; a smooth one is 2x2 of these
const int tileLevels = 4; // levels 5 and 6 are reduced by the blur

// Light as half floats may have it, where it enters. No less than none, so that no difference of two is larger than one is.
vec3 storableLight(vec3 light) {
    return clamp(light, vec3(0.0), vec3(maxHalf));
}

#include "bank_texel.glsl"

// Levels are made of 2x2 whole tiles, level 6 of a texel for 4x4; what lies outside the image is empty.
ivec2 levelExtent(int level) {
    return parameters.bankLevels[level].yz;
}

bool isInLevel(int level, ivec2 texel) {
    return texel == clamp(texel, ivec2(0), levelExtent(level) - 1);
}

int tileIndex(ivec2 tile) {
    return tile.y * levelExtent(tileLevels).x + tile.x;
}

// Smooth regions, of 32x16 px, two tiles side by side.
ivec2 regionCount() {
    return levelExtent(tileLevels) / ivec2(2, 1);
}

// The most regions that a list of smooth (0) or edge regions (1) may have.
uint listCapacity(int kind) {
    ivec2 regions = regionCount();
    return uint(regions.x * regions.y) * (kind == 0 ? 1u : 4u);
}

// Where an entry of a list is in tileEntries.
int listPlace(int kind, uint entry) {
    ivec2 regions = regionCount();
    return (2 + 2 * kind) * regions.x * regions.y + 2 * int(entry);
}

// A region on a list.
struct ListEntry {
    ivec2 part;    // its first
    uint skipped;  // of a smooth one: bits of the parts that it leaves out
    uint occupied; // occupiedBit of the tiles that it reads and that have tileOccupied; tileBright, if one of them has it
};

// Of a tile that lies so far from the one left of and above the region's first, and of all that a region of either kind reads.
uint occupiedBit(ivec2 tile) {
    return 1u << (4 * tile.y + tile.x);
}

// The tiles around the two of a smooth region, and around the one of an edge region (here the left one), by their bits:
//
//    0   1   2   3        0   1   2
//    4 [ 5   6 ] 7        4 [ 5 ] 6
//    8   9  10  11        8   9  10
const uint smoothReads = 0xfffu;
const uint edgeReads = 0x777u;

uint packPart(ListEntry entry) {
    return uint(entry.part.x) | uint(entry.part.y) << 12 | entry.skipped << 24;
}

// From its two words.
ListEntry unpackListEntry(uint part, uint occupied) {
    return ListEntry(ivec2(part & 0xfffu, part >> 12 & 0xfffu), part >> 24, occupied);
}

// A tile's entry.
//
//   bits      if set
//   0         tileOccupied: pixels have an id
//   1 … 18    tileStepBit: depth makes a step, or pixels were left out
//   19        tileBright: light enters that is negative or too large for sums of two differences in half floats
//
// tileStepBit is for a tile's 8x8 quads in groups of rows and columns, because a region asks of a tile the half that it has
// in it, and of those around the row or column of quads beside it (stepBitsBeside):
//
//   row of quads     0  1  2  3  4  5  6  7        column of quads  0  1  2  3  4  5  6  7
//   group            0  1  1  2  3  4  4  5        group            0  1  1  1  1  1  1  2
//   bit of the entry: 1 + 3 · row's group + column's group
const uint tileOccupied = 1u;
const uint tileBright = 1u << 19;
const uint tileRowGroups = 0x54432110u; // a hexadecimal digit a row, the first one last

uint tileStepBit(ivec2 quad) {
    int row = int(tileRowGroups >> 4 * quad.y & 7u);
    int column = (quad.x > 0 ? 1 : 0) + (quad.x == 7 ? 1 : 0);
    return 2u << (3 * row + column);
}

const float mostDimLight = 0.5 * maxHalf;

int texelIndex(int level, ivec2 texel) {
    ivec4 place = parameters.bankLevels[level];
    return place.x + texel.y * place.y + texel.x;
}

// Of a texel of the levels that are blurred, whose place in the whole pyramid `index` is.
int blurredIndex(int index) {
    return index - parameters.bankLevels[2].x;
}

// Of the same texel's second surface, blurred.
int blurredSecondIndex(int index) {
    return parameters.bankLevels[secondLevels + 1].x + blurredIndex(index);
}

// Where a thread is in a rectangle of a power of two columns, two rows at a time, so that four threads that follow one another
// are 2x2: images lie in memory so, and are fetched and stored faster.
ivec2 quadOrder(int thread, int columns) {
    int inRows = thread & 2 * columns - 1;
    return ivec2(thread & 1 | inRows >> 1 & ~1, inRows >> 1 & 1 | thread / columns & ~1);
}

// Position of one of the places around a rectangle, counted row above, row below, then the sides.
ivec2 ringPosition(int index, ivec2 size) {
    int width = size.x + 2;
    if (index < 2 * width) {
        return index < width ? ivec2(index - 1, -1) : ivec2(index - width - 1, size.y);
    }
    int side = index - 2 * width;
    return ivec2((side & 1) == 0 ? -1 : size.x, side >> 1);
}

// Width of a texel in mm, where the surface faces the camera; for a depth along the ray as much too wide as that ray is
// longer than the view's middle one. Level 0 are the pixels.
float texelWidth(int level, float depth) {
    return float(1 << level) * parameters.pixelWidth * clipW(view.distanceOrigin - depth);
}

// Of a base that is largest, and at most 1, at no distance: its fourth power; 0 where it is negative.
float falloffFrom(float base) {
    float least = clamp(base, 0.0, 1.0);
    float squared = least * least;
    return squared * squared;
}

// e^−q, near enough, and 0 from q = 4 on.
float falloff(float q) {
    return falloffFrom(1.0 - 0.25 * q);
}

// The same of a distance's square over that of a width times a variance. `scale`: depthScale, of these two.
float depthWeight(float distance, float scale) {
    return falloffFrom(1.0 - distance * distance * scale);
}

float depthScale(float width, float variance) {
    return 0.25 / (variance * width * width);
}

// What a kernel's share of a pixel is multiplied by, from the surface within its reach: Σ kernel · depth weight · area,
// which is 1 on a plane of any slope, and less where some is missing or away.
float coverageOf(float area) {
    return min(area, 1.0);
}

