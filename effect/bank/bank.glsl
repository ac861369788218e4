// What the three passes of `bank` share: the pyramid's texels, their packing and layout, depth weights.
#include "interface/scatter.glsl"
#include "bank_blocks.h"
#include "bank_constants.h"

// How a pass uses the buffers between passes; pass C says that it only reads them.
#ifndef BANK_ACCESS
#define BANK_ACCESS
#endif

layout(constant_id = 0) const bool separateMaterials = false; // some do not exchange light with some others

layout(set = 0, binding = bindingIntermediates + intermediateBankReduced, std430) BANK_ACCESS buffer BankRaw {
    uvec4 rawTexels[]; // levels 1 … 6; what is not written of level 1 lies in tiles without tileOccupied
};
layout(set = 0, binding = bindingIntermediates + intermediateBankBlurred, std430) BANK_ACCESS buffer BankBlurred {
    uvec2 blurredLights[]; // levels 2 … 6 (blurredIndex): light and mass, with a sign where the texel is not plain
};
layout(set = 0, binding = bindingIntermediates + intermediateBankBorrowed, std430) BANK_ACCESS buffer BankSurfaces {
    // Of the same texels: depth and material that an empty texel's kernel stands on. A raw texel that is not empty has both.
    uvec2 borrowedSurfaces[];
};
layout(set = 0, binding = bindingIntermediates + intermediateBankMaterials, std430) BANK_ACCESS buffer BankMaterials {
    uvec2 quadMaterials[]; // as level 1 lies: of the four pixels, only where they differ
};
layout(set = 0, binding = bindingIntermediates + intermediateBankAreas, std430) BANK_ACCESS buffer BankAreas {
    uint quadAreas[]; // as level 1 lies: packAreas of the four pixels, only where they do not share their area
};
layout(set = 0, binding = bindingIntermediates + intermediateBankSeconds, std430) BANK_ACCESS buffer BankSeconds {
    // Levels 1 … secondLevels, as rawTexels: only where a texel has a second surface (secondBit). Then, from level 2 on
    // (blurredSecondIndex), the same surfaces blurred: light and mass as in blurredLights, depth.
    uvec4 secondTexels[];
};
layout(set = 0, binding = bindingIntermediates + intermediateBankTiles, std430) BANK_ACCESS buffer BankTiles {
    BankDispatch dispatches[2]; // of the combination: smooth regions, edge regions
    // Per tile: tileOccupied, tileRough; then the lists of smooth regions and of edge regions, two words each (ListEntry).
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
const int rawLevels = 4; // levels 5 and 6 are reduced by the blur
// Of a raw texel's last word, from level 2 on: 0 = empty.
const uint massBits = 0x3fffu;
const uint fullMass = 0x3c00u;
const uint droppedBit = 0x8000u; // the mass's sign
const uint secondBit = 0x4000u;  // there, on level 1, too: the texel has a second surface; masses are below 2
const uint signBit = 0x80000000u;

// A texel of the reduced pyramid.
struct RawTexel {
    vec3 light;    // irradiance · area, mean over the texel's pixels
    float area;    // surface per pixel, relative to one that faces the camera, mean over the texel's pixels
    float mass;    // [0, 1] share of the texel's pixels that are on the surface; 0 = empty
    float depth;   // mm along the ray
    uint material; // one of the surface's
    bool dropped;  // pixels of another surface were left out, here or further down
};

// A texel of the blurred pyramid.
struct BlurredTexel {
    vec3 light; // mean irradiance · mass
    float mass; // [0, 1] share of the kernel that is on the surface
    float depth;
    uint material;
    bool present; // whether there is a surface near
    bool rough;   // whether a neighbour is on another surface, or on this one's steep side
};

RawTexel emptyTexel() {
    return RawTexel(vec3(0.0), 0.0, 0.0, 0.0, 0u, false);
}

// Light as half floats may have it, where it enters. No less than none, so that no difference of two is larger than one is.
vec3 storableLight(vec3 light) {
    return clamp(light, vec3(0.0), vec3(maxHalf));
}

// Light as the mean irradiance of the surface, so that a constant field is stored as what it is.
uvec4 packRaw(RawTexel texel) {
    uint mass = packHalf2x16(vec2(texel.dropped ? -texel.mass : texel.mass, 0.0));
    vec3 light = texel.light / max(texel.area, bankLeastWeight);
    return uvec4(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, texel.area)),
                 floatBitsToUint(texel.depth), mass | (separateMaterials ? texel.material << 16 : 0u));
}

RawTexel unpackRaw(uvec4 words) {
    vec2 redGreen = unpackHalf2x16(words.x);
    vec2 blueArea = unpackHalf2x16(words.y);
    float mass = unpackHalf2x16(words.w & ~secondBit).x;
    return RawTexel(vec3(redGreen, blueArea.x) * blueArea.y, blueArea.y, abs(mass), uintBitsToFloat(words.z), words.w >> 16,
                    mass < 0.0);
}

// A texel is plain where the surface is and stays smooth: bilinear weights will do for it.
uvec2 packBlurred(BlurredTexel texel) {
    uint sign = texel.present && !texel.rough ? 0u : signBit;
    return uvec2(packHalf2x16(texel.light.rg), packHalf2x16(vec2(texel.light.b, texel.mass)) | sign);
}

const uint mixedBit = 0x8000u; // of a quad: its pixels' materials are in quadMaterials

// Of a texel of level 1, the sign of its area: its pixels' areas are in quadAreas; else all are the texel's.
const uint areasBit = signBit;

// The last word of a texel of level 1, whose mass only pass A needs: what the combination wants to know of its 2x2 px. The
// weights beside the middle of the full-resolution 3x3 in x and y (packBeside) or, where the block is rough, packSpread, 14
// bits; secondBit; whether materials differ, and above them that of all four or, where they differ, the texel's.
uint packQuad(uint weights, uvec2 materials, uint texelMaterial) {
    bool mixed = materials != uvec2((materials.x & 0xffffu) * 0x10001u);
    return weights | (mixed ? mixedBit | texelMaterial << 16 : materials.x << 16);
}

uint packBeside(vec2 beside) {
    uvec2 weights = uvec2(254.0 * beside + 0.5);
    return weights.x | weights.y << 7;
}

vec2 besideOf(uint quad) {
    return vec2(quad & 127u, quad >> 7 & 127u) / 254.0;
}

// Where pixels make a step, the texel of level 1 stands for depths that vary, as a Gaussian. With a depth weight's variance v,
// both in texel widths squared:
struct DepthSpread {
    float closeness;  // (0, 1] v / (v + the depths' variance); squared distances to the texel count by so much
    float lightSlope; // covariance of light and depth / (v + the depths' variance) / light: its change per width of depth
};

const DepthSpread noSpread = DepthSpread(1.0, 0.0);

// In the last word of a texel of level 1 where smooth regions would look for packBeside; the sign of the texel's depth says so.
// The slope is less than √3 / 2 where pixels are no further apart than bankSurfaceSeparation.
const float mostLightSlope = 0.875;

uint packSpread(DepthSpread spread) {
    uint slope = uint(clamp(64.5 + (63.0 / mostLightSlope) * spread.lightSlope, 1.0, 127.0));
    return uint(127.0 * spread.closeness + 0.5) | slope << 7;
}

// From the last two words of a texel of level 1.
DepthSpread spreadOf(uvec2 words) {
    if ((words.x & signBit) == 0u) {
        return noSpread;
    }
    return DepthSpread(float(words.y & 127u) / 127.0, (float(words.y >> 7 & 127u) - 64.0) * (mostLightSlope / 63.0));
}

// Of the four pixels of level 1's texel at `index`, 16 bits each.
uvec2 materialsOf(uint quad, int index) {
    return (quad & mixedBit) != 0u ? quadMaterials[index] : uvec2((quad >> 16) * 0x10001u);
}

// The material of one of a quad's pixels, which is at an even or odd place in x and y.
uint pixelMaterial(uvec2 materials, ivec2 local) {
    uint words = (local.y & 1) == 0 ? materials.x : materials.y;
    return (local.x & 1) == 0 ? words & 0xffffu : words >> 16;
}

bool keepsSeconds(int level) {
    return secondLevels > 0 && level <= secondLevels;
}

// Levels are made of 2x2 whole tiles, level 6 of a texel for 4x4; what lies outside the image is empty.
ivec2 levelExtent(int level) {
    return parameters.bankLevels[level].yz;
}

bool isInLevel(int level, ivec2 texel) {
    return texel == clamp(texel, ivec2(0), levelExtent(level) - 1);
}

int tileIndex(ivec2 tile) {
    return tile.y * levelExtent(rawLevels).x + tile.x;
}

// Smooth regions, of 32x16 px, two tiles side by side.
ivec2 regionCount() {
    return levelExtent(rawLevels) / ivec2(2, 1);
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
    uint left;     // of a smooth one: bits of the parts that it leaves out
    uint occupied; // occupiedBit of the tiles that it reads and that have tileOccupied; tileBright, if one of them has it
};

// Of a tile that lies so far from the one left of and above the region's first, and of all that a region of either kind reads.
uint occupiedBit(ivec2 tile) {
    return 1u << (4 * tile.y + tile.x);
}

const uint smoothReads = 0xfffu; // 4x3 tiles
const uint edgeReads = 0x777u;   // 3x3

uint packPart(ListEntry entry) {
    return uint(entry.part.x) | uint(entry.part.y) << 12 | entry.left << 24;
}

// From its two words.
ListEntry unpackListEntry(uint part, uint occupied) {
    return ListEntry(ivec2(part & 0xfffu, part >> 12 & 0xfffu), part >> 24, occupied);
}

// Bits of a tile's entry: whether pixels have an id,
const uint tileOccupied = 1u;

// and whether depth makes a step or pixels were left out, by rows (the first, the next two, the fourth, and so from below)
// and columns (the first, the last, those between) of its 8x8 blocks of 2x2 px: eighteen in all. The one for a block.
uint tileRough(ivec2 block) {
    int row = int(0x54432110u >> 4 * block.y & 7u);
    int column = (block.x > 0 ? 1 : 0) + (block.x == 7 ? 1 : 0);
    return 2u << (3 * row + column);
}

// Whether light enters there that is negative or too large for sums of two differences in half floats.
const uint tileBright = 1u << 19;
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

// Where a thread is in a block of a power of two columns, two rows at a time, so that four threads that follow one another are
// 2x2: images lie in memory so, and are fetched and stored faster.
ivec2 quadOrder(int thread, int columns) {
    int inRows = thread & 2 * columns - 1;
    return ivec2(thread & 1 | inRows >> 1 & ~1, inRows >> 1 & 1 | thread / columns & ~1);
}

// Position of one of the places around a block, counted row above, row below, then the sides.
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

// Depth step from a pixel to the next along one axis, in pixel widths, from the depths on either side (0 = none): their
// mean or, where one side is a step to another surface, the smaller.
float pixelStep(float before, float depth, float after) {
    float width = texelWidth(0, depth);
    float onlyAfter = after > 0.0 ? after - depth : 0.0;
    float stepBefore = before > 0.0 ? depth - before : onlyAfter;
    float stepAfter = after > 0.0 ? onlyAfter : stepBefore;
    float smaller = min(abs(stepBefore), abs(stepAfter));
    float larger = max(abs(stepBefore), abs(stepAfter));
    bool goesOn = larger <= bankContinuedStep * max(smaller, width);
    return (goesOn ? 0.5 * (stepBefore + stepAfter) : smaller) / width;
}

// Area of a pixel's surface relative to one that faces the camera, from its own depth and those left, right, above, below.
float areaOf(float depth, vec4 around) {
    vec2 slope = vec2(pixelStep(around.x, depth, around.y), pixelStep(around.z, depth, around.w));
    return min(sqrt(1.0 + dot(slope, slope)), bankLargestArea);
}

// Areas in [1, bankLargestArea), each to within one percent: two bits of a float's exponent and six of its mantissa.
uint packAreas(vec4 areas) {
    uvec4 codes = min((floatBitsToUint(areas) - 0x3f7f0000u) >> 17, uvec4(255u));
    return codes.x | codes.y << 8 | codes.z << 16 | codes.w << 24;
}

float unpackArea(uint areas, int i) {
    return uintBitsToFloat(0x3f800000u + ((areas >> 8 * i & 255u) << 17));
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

// How much the taps beside the middle of the full-resolution 3x3 weigh, in x and y, on a slope of so many pixel widths a
// pixel.
vec2 weightsBeside(vec2 slope) {
    return 0.5 * vec2(falloff(slope.x * slope.x / bankPixelDepthVariance),
                      falloff(slope.y * slope.y / bankPixelDepthVariance));
}

// What a kernel's share of a pixel is multiplied by, from the surface within its reach: Σ kernel · depth weight · area,
// which is 1 on a plane of any slope, and less where some is missing or away.
float massOf(float area) {
    return min(area, 1.0);
}

// Depths further apart than this, in mm, are two surfaces of a texel whose nearest depth this is.
float separationAt(int level, float nearest) {
    return (keepsSeconds(level) ? bankSecondSeparation : bankSurfaceSeparation) * texelWidth(level, nearest);
}

const vec2 noRange = vec2(1e30, 0.0);

// Nearest and farthest depth of the texels that are not empty.
vec2 depthRange(RawTexel texels[4]) {
    vec2 range = noRange;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        float depth = texels[i].depth;
        range = vec2(texels[i].mass > 0.0 ? min(range.x, depth) : range.x, max(range.y, depth)); // 0 where it is empty
    }
    return range;
}

// Which of four texels the next level's texel keeps: those of one surface, nearest or farthest, whichever has more
// mass; and of those, where materials are separate, the ones that exchange light with the heaviest.
bvec4 chooseSurface(RawTexel texels[4], int level) {
    vec2 range = depthRange(texels);
    float separation = separationAt(level, range.x);
    float front = 0.0; // mass within reach of the nearest depth,
    float back = 0.0;  // and of the farthest; both are all of it where all is one surface
    [[unroll]] for (int i = 0; i < 4; ++i) { // an empty texel has no mass
        front += texels[i].depth <= range.x + separation ? texels[i].mass : 0.0;
        back += texels[i].depth >= range.y - separation ? texels[i].mass : 0.0;
    }
    float surface = front >= back ? range.x : range.y;
    bvec4 kept;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        kept[i] = texels[i].mass > 0.0 && abs(texels[i].depth - surface) <= separation;
    }
    if (separateMaterials) {
        float heaviest = 0.0;
        uint material = 0u;
        for (int i = 0; i < 4; ++i) {
            if (kept[i] && texels[i].mass > heaviest) {
                heaviest = texels[i].mass;
                material = texels[i].material;
            }
        }
        for (int i = 0; i < 4; ++i) {
            kept[i] = kept[i] && exchanges(texels[i].material, material);
        }
    }
    return kept;
}

// The next level's texel from the kept of the four below it.
RawTexel mergeTexels(RawTexel texels[4], bvec4 kept) {
    RawTexel result = emptyTexel();
    float heaviest = 0.0;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        if (kept[i]) {
            result.light += 0.25 * texels[i].light;
            result.area += 0.25 * texels[i].area;
            result.mass += 0.25 * texels[i].mass;
            result.depth += 0.25 * texels[i].mass * texels[i].depth;
            if (separateMaterials && texels[i].mass > heaviest) {
                heaviest = texels[i].mass;
                result.material = texels[i].material;
            }
        }
        result.dropped = result.dropped || (kept[i] ? texels[i].dropped : texels[i].mass > 0.0);
    }
    result.depth = result.mass > 0.0 ? result.depth / result.mass : 0.0;
    return result;
}

RawTexel reduceTexels(RawTexel texels[4], int level) {
    return mergeTexels(texels, chooseSurface(texels, level));
}
