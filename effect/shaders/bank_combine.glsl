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

Mixture findMixture(uint material, float depth) {
    uint first = material * bankTableWords;
    vec2 head = uintBitsToFloat(bankTables[first].xy);
    float position = head.x - float(bankBinsPerOctave) * log2(texelWidth(0, depth));
    position = clamp(position, 0.0, float(bankBinCount - 1));
    uint bin = min(uint(position), uint(bankBinCount - 2));
    return Mixture(first + 1u + bin * bankBinWords, position - float(bin), head.y);
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

// What light is interpolated in. As differences times fractions, so that a constant field stays exactly what it is.
#ifdef HALF_FLOATS
#define Real float16_t
#define Light f16vec4
Light storedLight(uvec2 words) {
    return Light(unpackFloat2x16(words.x), unpackFloat2x16(words.y));
}
#else
#define Real float
#define Light vec4
Light storedLight(uvec2 words) {
    return unpackLight(words);
}
#endif

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

// The identity.
void addIdentity(inout Sum sums[4], Mixture mixture, ivec2 first) {
    vec3 weight = max(kernelWeight(mixture, 0), vec3(bankLeastIdentity));
    [[unroll]] for (int i = 0; i < 4; ++i) {
        add(sums[i], weight, lightAt(first + ivec2(i & 1, i >> 1)));
    }
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
    vec2 fraction = corner.fraction;
    Light upperLeft = storedLight(levelLights[corner.index]);
    Light lowerLeft = storedLight(levelLights[below]);
    Light upperSlope = storedLight(levelLights[corner.index + 1]) - upperLeft;
    Light lowerSlope = storedLight(levelLights[below + 1]) - lowerLeft;
    [[unroll]] for (int x = 0; x < 2; ++x) {
        Light upper = upperLeft + Real(fraction.x) * upperSlope;
        Light slope = lowerLeft + Real(fraction.x) * lowerSlope - upper;
        add(sums[x], weight, vec4(upper + Real(fraction.y) * slope));
        add(sums[x + 2], weight, vec4(upper + Real(fraction.y + step) * slope));
        fraction.x += step;
    }
}

const float levelDepthVariance = secondLevels > 0 ? bankSurfacesLevelDepthVariance : bankLevelDepthVariance;
const float levelAwayVariance = secondLevels > 0 ? bankSurfacesLevelAwayVariance : bankLevelAwayVariance;

// A level's texel as a tap for a surface at `depth`: premultiplied by its depth weight, which is `total`.
struct Tap {
    vec4 light; // w: mass
    float total;
    float away; // mm, how far behind `depth` the texel's surface is
};

Tap weightedTap(uvec2 light, uvec2 surface, float depth, float scale, uint material) {
    float difference = uintBitsToFloat(surface.x) - depth;
    bool taken = (surface.y & massBits) != 0u && givesLight(surface.y >> 16, material);
    float weight = taken ? falloff(difference * difference * scale) : 0.0;
    return Tap(weight * unpackLight(uvec2(light.x, light.y & ~signBit)), weight, weight * difference);
}

Tap joinTaps(Tap a, Tap b) {
    return Tap(a.light + b.light, a.total + b.total, a.away + b.away);
}

Tap mixTaps(Tap a, Tap b, float fraction) {
    return Tap(mix(a.light, b.light, fraction), mix(a.total, b.total, fraction), mix(a.away, b.away, fraction));
}

// A level's share of a pixel. On a slope the taps' weighted mean depth is the pixel's, which is `offset` behind the taps'
// `depth`; where it is away from there, they stand on another surface, and the share falls. `scale`: levelScale.
void addTap(inout Sum sum, vec3 weight, Tap tap, float offset, float scale) {
    float normalization = 1.0 / max(tap.total, bankLeastWeight);
    float away = tap.away * normalization - offset;
    float share = falloff(away * away * scale * (levelDepthVariance / levelAwayVariance));
    add(sum, weight, tap.light * (share * normalization));
}

// 1 / (levelDepthVariance · t²)
float levelScale(int level, float depth) {
    float width = texelWidth(level, depth);
    return 1.0 / (levelDepthVariance * width * width);
}

// In edge regions that of level 1, too.
uvec2 levelSurface(int index) {
    return isEdge && index < fineCount ? fineSurfaces[index] : coarseSurfaces[index - fineCount];
}

// The four texels around, for a surface at `depth`.
Tap[4] cornerTaps(int level, Corner corner, float depth, uint material) {
    float scale = levelScale(level, depth);
    Tap taps[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int index = corner.index + (i & 1) + (i >> 1) * levelPitch[level].x;
        uvec2 surface = levelSurface(index);
        taps[i] = weightedTap(levelLights[index], surface, depth, scale, material);
        if (hasSecond(index, surface)) {
            Tap second = weightedTap(secondLights[index], secondSurfaceWords[index], depth, scale, material);
            taps[i] = joinTaps(taps[i], second);
        }
    }
    return taps;
}

// Adds a level with depth weights, which the quad's pixels share.
void addWeightedLevel(inout Sum sums[4], vec3 weight, int level, Corner corner, float depth, vec4 offsets,
                      uint material) {
    float scale = levelScale(level, depth);
    Tap taps[4] = cornerTaps(level, corner, depth, material);
    vec2 fraction = corner.fraction;
    float step = 1.0 / float(1 << level);
    [[unroll]] for (int x = 0; x < 2; ++x) {
        Tap upper = mixTaps(taps[0], taps[1], fraction.x);
        Tap lower = mixTaps(taps[2], taps[3], fraction.x);
        addTap(sums[x], weight, mixTaps(upper, lower, fraction.y), offsets[x], scale);
        addTap(sums[x + 2], weight, mixTaps(upper, lower, fraction.y + step), offsets[x + 2], scale);
        fraction.x += step;
    }
}

// The levels from 2 or, in edge regions with second surfaces, 3 on: the quad's pixels lie between the same four texels. They
// are `offsets` behind `depth`.
void addCoarseLevels(inout Sum sums[4], Mixture mixture, ivec2 region, ivec2 quad, float depth, vec4 offsets,
                     uint material) {
    [[dont_unroll]] for (int level = (isEdge ? ownDepthLevels : 1) + 1; level <= bankLevels; ++level) {
        vec3 weight = kernelWeight(mixture, level + 1);
        if (weight != vec3(0.0)) {
            Corner corner = levelCorner(level, region, quad);
            if ((roughLevels >> level & 1u) == 0u && !separateMaterials) {
                addPlainLevel(sums, weight, level, corner);
            } else {
                addWeightedLevel(sums, weight, level, corner, depth, offsets, material);
            }
        }
    }
}

// Writes the pixels of a quad that share a material. `place`: of its first in shared memory; of their light there what is
// not scattered leaves.
void storeGroup(ivec2 quad, ivec2 place, bvec4 members, uint material, float strength, Sum sums[4]) {
    ivec2 first = quad + view.areaOffset;
    vec4 strengths = vec4(strength);
    if (hasFlag(flagStrength)) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            strengths[i] *= members[i] ? strengthAt(first + ivec2(i & 1, i >> 1)) : 1.0;
        }
    }
    vec3 leaving[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        vec4 own = lightAt(place + ivec2(i & 1, i >> 1));
        leaving[i] = mix(own.rgb, quotient(sums[i]), own.w > 0.0 ? strengths[i] : 1.0);
    }
    if (hasFlag(flagAlbedo)) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            leaving[i] *= members[i] ? albedoAfter(first + ivec2(i & 1, i >> 1), material) : vec3(1.0);
        }
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        if (members[i]) {
            imageStore(scatteredImage, first + ivec2(i & 1, i >> 1), vec4(leaving[i], 1.0));
        }
    }
}

// Writes the pixels of a quad that have no material.
void storeRest(ivec2 quad, uint ownMaterials[4]) {
    if (min(min(ownMaterials[0], ownMaterials[1]), min(ownMaterials[2], ownMaterials[3])) != 0u) {
        return;
    }
    for (int i = 0; i < 4; ++i) {
        ivec2 local = quad + ivec2(i & 1, i >> 1);
        uint material = i < 2 ? (i == 0 ? ownMaterials[0] : ownMaterials[1])
                              : (i == 2 ? ownMaterials[2] : ownMaterials[3]);
        if (material == 0u && all(lessThan(local, view.areaExtent))) {
            writeUnscattered(local + view.areaOffset);
        }
    }
}
