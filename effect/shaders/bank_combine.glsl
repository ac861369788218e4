// What the two pipelines of pass C of `bank` share: the material's mixture of a region's kernels, storing the result.
// docs/scatter.md.
#include "bank_region.glsl"

layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    uvec4 bankTables[]; // bankTableWords a material
};

// Numerator and denominator of a pixel's result, per channel.
struct Sum {
    vec2 light; // red and green
    vec2 blue;  // light and mass
    vec2 mass;  // of red and green
};

const Sum noSum = Sum(vec2(0.0), vec2(0.0), vec2(0.0));

// A material's weights of the kernels at a scale.
struct Mixture {
    uint first;     // of the bin, in bankTables
    float fraction; // [0, 1] towards the next
    float strength;
};

// `pixel`: near where. A surface across the view direction is seen at the same scale everywhere.
Mixture findMixture(uint material, float depth, ivec2 pixel) {
    uint first = material * bankTableWords;
    vec2 head = uintBitsToFloat(bankTables[first].xy);
    float position = head.x - float(bankBinsPerOctave) * log2(texelWidth(0, depth / stretchAt(pixel)));
    position = clamp(position, 0.0, float(bankBinCount - 1));
    uint bin = min(uint(position), uint(bankBinCount - 2));
    return Mixture(first + 1u + bin * bankBinWords, position - float(bin), head.y);
}

// Bits of the kernels that have a weight.
uint usedKernels(Mixture mixture) {
    return bankTables[mixture.first].w;
}

// Red, green and blue.
vec3 kernelWeight(Mixture mixture, int kernel) {
    uvec4 words = bankTables[mixture.first + uint(kernel)];
    vec2 blue = unpackHalf2x16(words.z);
    return mix(vec3(unpackHalf2x16(words.x), blue.x), vec3(unpackHalf2x16(words.y), blue.y), mixture.fraction);
}

vec4 unpackLight(uvec2 words) {
    return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
}

void add(inout Sum sum, vec3 weight, vec4 lightAndMass) {
    sum.light += weight.rg * lightAndMass.rg;
    sum.blue += weight.b * lightAndMass.ba;
    sum.mass += weight.rg * lightAndMass.a;
}

vec3 quotient(Sum sum) {
    vec3 light = vec3(sum.light, sum.blue.x);
    vec3 mass = vec3(sum.mass, sum.blue.y);
    return light / max(mass, vec3(1e-20));
}

// A pixel's light in shared memory, at a place counted as for pixelPlace.
vec4 lightAt(ivec2 pixel) {
    return unpackLight(pixelLights[pixelPlace(pixel)]);
}

// The identity. `first`: place of the thread's first pixel in shared memory.
void addIdentity(inout Sum sums[ownPixels], Mixture mixture, ivec2 first) {
    vec3 weight = max(kernelWeight(mixture, 0), vec3(bankLeastIdentity));
    [[unroll]] for (int i = 0; i < ownPixels; ++i) {
        add(sums[i], weight, lightAt(first + ivec2(i & 1, i >> 1)));
    }
}

// Where a thread's pixels lie between four texels of a level.
struct Corner {
    int place;     // in shared memory, of the texel up and left of the first pixel
    vec2 fraction; // of that pixel, towards the next texels
};

Corner levelCorner(int level, ivec2 region, ivec2 local) {
    ivec2 texel = (local - (1 << (level - 1))) >> level;
    vec2 fraction = (vec2(local) + 0.5) / float(1 << level) - 0.5 - vec2(texel);
    ivec2 inRegion = texel - levelFirst(level, region);
    return Corner(levelStart[level] + inRegion.y * levelPitch[level].x + inRegion.x, fraction);
}

const float levelDepthVariance = secondLevels > 0 ? bankSurfacesLevelDepthVariance : bankLevelDepthVariance;
const float levelAwayVariance = secondLevels > 0 ? bankSurfacesLevelAwayVariance : bankLevelAwayVariance;

// 1 / (levelDepthVariance · t²)
float levelScale(int level, float depth) {
    float width = texelWidth(level, depth);
    return 1.0 / (levelDepthVariance * width * width);
}

// How much a surface of a level weighs for one that it is `distance` mm behind. `scale`: levelScale.
float surfaceWeight(uvec2 surface, float distance, float scale, uint material) {
    bool taken = (surface.y & massBits) != 0u && givesLight(surface.y >> 16, material);
    return taken ? falloff(distance * distance * scale) : 0.0;
}

vec4 weightedLight(uvec2 words) {
    return unpackLight(uvec2(words.x, words.y & ~signBit));
}

// Texels of a level, weighted by place and depth, as a surface sees them.
struct Taps {
    vec4 light; // w: mass
    float total;
    float away; // mm, how far behind that surface theirs are
};

// A level's share of a pixel. On a slope the taps' weighted mean depth is the pixel's; where it is away from there, they
// stand on another surface, and the share falls. `scale`: levelScale.
void addTaps(inout Sum sum, vec3 weight, Taps taps, float scale) {
    float normalization = 1.0 / max(taps.total, bankLeastWeight);
    float away = taps.away * normalization;
    float share = falloff(away * away * scale * (levelDepthVariance / levelAwayVariance));
    add(sum, weight, taps.light * (share * normalization));
}

// Writes those of the thread's pixels that are members of a group, which share a material. `local`: the first; `place`:
// of it in shared memory; of the pixels' light there what is not scattered leaves.
void storeGroup(ivec2 local, ivec2 place, bvec4 members, uint material, float strength, Sum sums[ownPixels]) {
    ivec2 first = local + view.areaOffset;
    vec3 leaving[ownPixels];
    [[unroll]] for (int i = 0; i < ownPixels; ++i) {
        leaving[i] = quotient(sums[i]);
    }
    if (strength < 1.0 || hasFlag(flagStrength)) {
        [[unroll]] for (int i = 0; i < ownPixels; ++i) {
            float share = strength * (members[i] ? strengthAt(first + ivec2(i & 1, i >> 1)) : 1.0);
            vec4 own = lightAt(place + ivec2(i & 1, i >> 1));
            leaving[i] = mix(own.rgb, leaving[i], own.w > 0.0 ? share : 1.0);
        }
    }
    if (hasFlag(flagAlbedo)) {
        [[unroll]] for (int i = 0; i < ownPixels; ++i) {
            leaving[i] *= members[i] ? albedoAfter(first + ivec2(i & 1, i >> 1), material) : vec3(1.0);
        }
    }
    [[unroll]] for (int i = 0; i < ownPixels; ++i) {
        if (members[i]) {
            imageStore(scatteredImage, first + ivec2(i & 1, i >> 1), vec4(leaving[i], 1.0));
        }
    }
}

// Writes the thread's other pixels. `scattering`: bits of those that have a material.
void storeRest(ivec2 first, uint scattering) {
    for (int i = 0; i < ownPixels; ++i) {
        ivec2 local = first + ivec2(i & 1, i >> 1);
        if ((scattering >> i & 1u) == 0u && all(lessThan(local, view.areaExtent))) {
            writeUnscattered(local + view.areaOffset);
        }
    }
}
