// What the two pipelines of pass C of `bank` share: loading a region, the material's mixture, storing the result.
// 32x16 px a workgroup, two workgroups a tile, a 2x2 quad a thread. docs/scatter.md.
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 8) in;
layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    uvec4 bankTables[]; // bankTableWords / 4 a material: the bin offset, unused, then three a bin: 24 halves
};

const int threads = 128;
const ivec2 regionSize = ivec2(32, 16); // px
const ivec2 fineSize = regionSize / 2;  // texels of level 1, the quads
const int finePitch = fineSize.x + 2;   // with one texel around
const int fineCount = finePitch * (fineSize.y + 2);
// The texels of level l ≥ 2 that the region's pixels read: from one before its first on, at most this many.
const ivec2 levelPitch[bankLevels + 1] = ivec2[](ivec2(0), ivec2(finePitch, fineSize.y + 2), ivec2(10, 6), ivec2(6, 4),
                                                 ivec2(4, 3), ivec2(3, 3), ivec2(3, 3));
const int levelStart[bankLevels + 2] = int[](0, 0, 180, 240, 264, 276, 285, 294);
const int coarseCount = levelStart[bankLevels + 1] - fineCount;
const int levelTexelCount = levelStart[bankLevels + 1];

shared uvec2 levelLights[levelTexelCount]; // as blurredLights
// Bit l: some texel of level l is not plain, and taps have depth weights of their own; else bilinear ones will do.
shared uint roughLevels;

// Numerator and denominator of a pixel's result, per channel.
struct Sum {
    vec3 light;
    vec3 mass;
};

// The region that this workgroup combines, in px of the render area; false where there is none.
bool findRegion(int kind, out ivec2 region) {
    ivec2 tiles = tileCount();
    uint entry = gl_WorkGroupID.y * bankDispatchWidth + gl_WorkGroupID.x;
    if (gl_NumWorkGroups.y > 1u && entry >= dispatches[kind].count) { // the last row is not full
        return false;
    }
    int index = int(tileEntries[tiles.x * tiles.y * (1 + 2 * kind) + int(entry)]);
    int tile = index >> 1;
    region = ivec2(tile % tiles.x, tile / tiles.x) * tileSize + ivec2(0, (index & 1) * regionSize.y);
    return true;
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

// The first texel of a level in shared memory.
ivec2 levelFirst(int level, ivec2 region) {
    return (region >> level) - 1;
}

int globalIndex(int level, ivec2 texel) {
    return texelIndex(level, clamp(texel, ivec2(0), levelExtent(level) - 1));
}

// A texel of the levels from 2 on: its level and where it is in the pyramid.
int coarseIndex(int index, ivec2 region, out int level) {
    level = 2;
    int pitch = 10;
    int start = 0;
    [[unroll]] for (int next = 3; next <= bankLevels; ++next) {
        if (index >= levelStart[next] - fineCount) {
            level = next;
            pitch = levelPitch[next].x;
            start = levelStart[next] - fineCount;
        }
    }
    int row = int((float(index - start) + 0.5) / float(pitch));
    return globalIndex(level, levelFirst(level, region) + ivec2(index - start - row * pitch, row));
}

int fineIndex(ivec2 texel) {
    return (texel.y + 1) * finePitch + texel.x + 1;
}

// The light of a material in the table's bins around a scale, and how far it is towards the second.
struct Mixture {
    uvec4 bins[6];
    float fraction;
};

Mixture findMixture(uint material, float depth) {
    uint first = material * (bankTableWords / 4u);
    float position =
        uintBitsToFloat(bankTables[first].x) - float(bankBinsPerOctave) * log2(texelWidth(0, depth));
    position = clamp(position, 0.0, float(bankBinCount - 1));
    uint bin = min(uint(position), uint(bankBinCount - 2));
    first += bankTableHead / 4u + bin * (bankBinWords / 4u);
    Mixture mixture;
    [[unroll]] for (uint i = 0u; i < 6u; ++i) {
        mixture.bins[i] = bankTables[first + i];
    }
    mixture.fraction = position - float(bin);
    return mixture;
}

// Red, green and blue of a kernel: halves 3·kernel … of a bin.
vec3 binWeight(Mixture mixture, int bin, int kernel) {
    int word = 3 * kernel / 2;
    vec2 low = unpackHalf2x16(mixture.bins[3 * bin + word / 4][word % 4]);
    vec2 high = unpackHalf2x16(mixture.bins[3 * bin + (word + 1) / 4][(word + 1) % 4]);
    return (kernel & 1) == 0 ? vec3(low, high.x) : vec3(low.y, high);
}

vec3 kernelWeight(Mixture mixture, int kernel) {
    return mix(binWeight(mixture, 0, kernel), binWeight(mixture, 1, kernel), mixture.fraction);
}

vec4 unpackLight(uvec2 words) {
    return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
}

void add(inout Sum sum, vec3 weight, vec4 lightAndMass) {
    sum.light += weight * lightAndMass.rgb;
    sum.mass += weight * lightAndMass.a;
}

// Where a quad lies between four texels of a level.
struct Corner {
    int index;     // in shared memory, of the texel up and left of its first pixel
    vec2 fraction; // of that pixel, towards the next texels
};

Corner levelCorner(int level, ivec2 region, ivec2 local) {
    ivec2 texel = (local - (1 << (level - 1))) >> level;
    vec2 fraction = (vec2(local) + 0.5) / float(1 << level) - 0.5 - vec2(texel);
    ivec2 inRegion = texel - levelFirst(level, region);
    return Corner(levelStart[level] + inRegion.y * levelPitch[level].x + inRegion.x, fraction);
}

// Adds a level with bilinear weights.
void addPlainLevel(inout Sum sums[4], vec3 weight, int level, Corner corner) {
    int below = corner.index + levelPitch[level].x;
    float step = 1.0 / float(1 << level);
    vec4 upperLeft = unpackLight(levelLights[corner.index]);
    vec4 lowerLeft = unpackLight(levelLights[below]);
    vec4 upperSlope = unpackLight(levelLights[corner.index + 1]) - upperLeft;
    vec4 lowerSlope = unpackLight(levelLights[below + 1]) - lowerLeft;
    [[unroll]] for (int x = 0; x < 2; ++x) {
        vec4 upper = upperLeft + (corner.fraction.x + float(x) * step) * upperSlope;
        vec4 slope = lowerLeft + (corner.fraction.x + float(x) * step) * lowerSlope - upper;
        add(sums[x], weight, upper + corner.fraction.y * slope);
        add(sums[x + 2], weight, upper + (corner.fraction.y + step) * slope);
    }
}

// A level's texel as a tap for a surface at `depth`: premultiplied by its depth weight, which is `total`.
struct Tap {
    vec4 light; // w: mass
    float total;
    float away; // mm, the texel's surface behind the pixel's
};

Tap weightedTap(uvec2 light, uvec2 surface, float depth, float scale, bool taken) {
    float difference = uintBitsToFloat(surface.x) - depth;
    float weight = taken && surface.y >= presentBit ? falloff(difference * difference * scale) : 0.0;
    return Tap(weight * unpackLight(uvec2(light.x, light.y & ~signBit)), weight, weight * difference);
}

Tap mixTaps(Tap a, Tap b, float fraction) {
    return Tap(mix(a.light, b.light, fraction), mix(a.total, b.total, fraction), mix(a.away, b.away, fraction));
}

// A level's share. On a slope the taps' weighted mean depth is the pixel's; where it is away, they stand on another
// surface, and the share falls. `scale`: levelScale.
void addTap(inout Sum sum, vec3 weight, Tap tap, float scale) {
    float normalization = 1.0 / max(tap.total, bankLeastWeight);
    float away = tap.away * normalization;
    float share = falloff(away * away * scale * (bankLevelDepthVariance / bankLevelAwayVariance));
    add(sum, weight, tap.light * (share * normalization));
}

void addTaps(inout Sum sum, vec3 weight, Tap upperLeft, Tap upperRight, Tap lowerLeft, Tap lowerRight, vec2 fraction,
             float scale) {
    addTap(sum, weight, mixTaps(mixTaps(upperLeft, upperRight, fraction.x), mixTaps(lowerLeft, lowerRight, fraction.x),
                                fraction.y), scale);
}

// 1 / (bankLevelDepthVariance · t²)
float levelScale(int level, float depth) {
    float width = texelWidth(level, depth);
    return 1.0 / (bankLevelDepthVariance * width * width);
}

// Writes a quad: what leaves pixels of a material, the rest as it is.
void storeQuad(ivec2 quad, uint quadMaterials[4], vec3 leaving[4]) {
    bool isPlain = !hasFlag(flagAlbedo) && all(lessThan(quad + 1, view.areaExtent)) &&
                   min(min(quadMaterials[0], quadMaterials[1]), min(quadMaterials[2], quadMaterials[3])) != 0u;
    ivec2 first = quad + view.areaOffset;
    if (isPlain) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            imageStore(scatteredImage, first + ivec2(i & 1, i >> 1), vec4(leaving[i], 1.0));
        }
        return;
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        if (all(lessThan(quad + offset, view.areaExtent))) {
            if (quadMaterials[i] == 0u) {
                writeUnscattered(first + offset);
            } else {
                writeLight(first + offset, quadMaterials[i], leaving[i]);
            }
        }
    }
}
