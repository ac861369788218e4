// What the three passes of `bank` share: the pyramid's texels, their packing and layout, depth weights.
#include "scatter.glsl"
#include "bank_constants.h"

layout(set = 0, binding = bindingIntermediates + intermediateBankRaw, std430) buffer BankRaw {
    uvec4 rawTexels[]; // levels 1 … 5
};
layout(set = 0, binding = bindingIntermediates + intermediateBankBlurred, std430) buffer BankBlurred {
    uvec4 blurredTexels[]; // levels 1 … 6
};
layout(set = 0, binding = bindingIntermediates + intermediateBankTiles, std430) buffer BankTiles {
    BankDispatch dispatches[2]; // of the combination: smooth tiles, edge tiles
    uint tileEntries[];         // per tile: occupied; then the list of smooth tiles, then that of edge tiles
};

const int tileSize = 32; // px; level l has tileSize / 2^l texels a side in each tile
const int rawLevels = 5; // level 6 is reduced by the blur
const float maxHalf = 65504.0;
const uint presentBit = 0x10000u; // in the last word of a blurred texel, above the material
const uint roughBit = 0x20000u;

// A texel of the reduced pyramid.
struct RawTexel {
    vec3 light;    // mean irradiance of the surface
    float area;    // surface per pixel of the texel, relative to one that faces the camera
    float mass;    // [0, 1] share of the texel's pixels that are on the surface; 0 = empty
    float depth;   // mm, −z in view space
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

uvec4 packRaw(RawTexel texel) {
    uint mass = packHalf2x16(vec2(texel.dropped ? -texel.mass : texel.mass, 0.0));
    return uvec4(packHalf2x16(texel.light.rg), packHalf2x16(vec2(texel.light.b, texel.area)),
                 floatBitsToUint(texel.depth), mass | texel.material << 16);
}

RawTexel unpackRaw(uvec4 words) {
    vec2 redGreen = unpackHalf2x16(words.x);
    vec2 blueArea = unpackHalf2x16(words.y);
    float mass = unpackHalf2x16(words.w).x;
    return RawTexel(vec3(redGreen, blueArea.x), blueArea.y, abs(mass), uintBitsToFloat(words.z), words.w >> 16,
                    mass < 0.0);
}

uvec4 packBlurred(BlurredTexel texel) {
    return uvec4(packHalf2x16(texel.light.rg), packHalf2x16(vec2(texel.light.b, texel.mass)),
                 floatBitsToUint(texel.depth),
                 texel.material | (texel.present ? presentBit : 0u) | (texel.rough ? roughBit : 0u));
}

BlurredTexel unpackBlurred(uvec4 words) {
    vec2 redGreen = unpackHalf2x16(words.x);
    vec2 blueMass = unpackHalf2x16(words.y);
    return BlurredTexel(vec3(redGreen, blueMass.x), blueMass.y, uintBitsToFloat(words.z), words.w & 0xffffu,
                        (words.w & presentBit) != 0u, (words.w & roughBit) != 0u);
}

ivec2 tileCount() {
    return (view.areaExtent + tileSize - 1) / tileSize;
}

// Levels are made of whole tiles, level 6 of half ones; what lies outside the image is empty.
ivec2 levelExtent(int level) {
    return level <= rawLevels ? tileCount() * (tileSize >> level) : (tileCount() + 1) / 2;
}

// The levels lie one after the other: 4^(5 − l) texels a tile in level l, 341 in the first five.
int texelIndex(int level, ivec2 texel) {
    ivec2 tiles = tileCount();
    int before = 341 - (1365 >> (2 * level)); // Σ 4^(5 − k), k < l
    return tiles.x * tiles.y * before + texel.y * levelExtent(level).x + texel.x;
}

RawTexel rawTexel(int level, ivec2 texel) {
    bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, levelExtent(level)));
    return inside ? unpackRaw(rawTexels[texelIndex(level, texel)]) : emptyTexel();
}

// Width of a texel in mm, where the surface faces the camera. Level 0 are the pixels.
float texelWidth(int level, float depth) {
    return float(1 << level) * parameters.pixelWidth * clipW(-depth);
}

// e^−q, near enough, and 0 from q = 4 on.
float falloff(float q) {
    float base = max(0.0, 1.0 - 0.25 * q);
    base *= base;
    return base * base;
}

// What a tap adds to the denominator: on the surface its weight, on another one the weight it would have had.
float countedWeight(float kernel, float weight, float depthDifference, float width) {
    return weight + clamp(abs(depthDifference) / width - bankMissingDepth, 0.0, 1.0) * kernel;
}

// Whether a texel or pixel gives light to a material. Materials are asked only in frames where some do not exchange.
bool givesLight(uint from, uint to) {
    return !hasFlag(flagSeparateMaterials) || exchanges(from, to);
}

// Which of four texels the next level's texel keeps: those of one surface, nearest or farthest, whichever has more
// mass; and of those, where materials are separate, the ones that exchange light with the heaviest.
bvec4 chooseSurface(RawTexel texels[4], int level) {
    bvec4 valid;
    float nearest = 1e30;
    float farthest = -1e30;
    for (int i = 0; i < 4; ++i) {
        valid[i] = texels[i].mass > 0.0;
        nearest = valid[i] ? min(nearest, texels[i].depth) : nearest;
        farthest = valid[i] ? max(farthest, texels[i].depth) : farthest;
    }
    bvec4 kept = valid;
    float separation = bankSurfaceSeparation * texelWidth(level, nearest);
    if (farthest - nearest > separation) {
        bvec4 front;
        bvec4 back;
        float balance = 0.0;
        for (int i = 0; i < 4; ++i) {
            front[i] = valid[i] && texels[i].depth - nearest <= separation;
            back[i] = valid[i] && farthest - texels[i].depth <= separation;
            balance += (front[i] ? texels[i].mass : 0.0) - (back[i] ? texels[i].mass : 0.0);
        }
        kept = balance >= 0.0 ? front : back;
    }
    if (hasFlag(flagSeparateMaterials)) {
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

// The next level's texel from the four below it.
RawTexel reduceTexels(RawTexel texels[4], bvec4 kept) {
    RawTexel result = emptyTexel();
    float heaviest = 0.0;
    for (int i = 0; i < 4; ++i) {
        if (kept[i]) {
            result.light += texels[i].area * texels[i].light;
            result.area += texels[i].area;
            result.mass += texels[i].mass;
            result.depth += texels[i].mass * texels[i].depth;
            if (texels[i].mass > heaviest) {
                heaviest = texels[i].mass;
                result.material = texels[i].material;
            }
        }
        result.dropped = result.dropped || (kept[i] ? texels[i].dropped : texels[i].mass > 0.0);
    }
    if (result.mass > 0.0) {
        result.light /= result.area;
        result.depth /= result.mass;
        result.area *= 0.25;
        result.mass *= 0.25;
    }
    return result;
}
