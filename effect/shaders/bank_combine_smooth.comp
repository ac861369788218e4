// Pass C of `bank` for regions without depth discontinuities: every pixel's mixture of the identity, the
// full-resolution 3x3 and the six blurred levels, with its material's weights. With HALF_FLOATS light is
// interpolated in half floats. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#ifdef HALF_FLOATS
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require
#endif
const bool isEdge = false;
#include "bank_combine.glsl"

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

// The full-resolution 3x3 of a quad on a slope: taps have its depths, which makes their weights separable, `beside` the
// middle in x and y. Rows are mixed in floats: fewer roundings.
void addSlopePixels(inout Sum sums[4], vec3 weight, ivec2 first, vec2 beside) {
    vec2 side = beside / (1.0 + 2.0 * beside);
    Light rows[4][2]; // the block's rows, filtered along x for the quad's two columns
    [[unroll]] for (int y = 0; y < 4; ++y) {
        Light row[4];
        [[unroll]] for (int x = 0; x < 4; ++x) {
            row[x] = storedLight(pixelLights[pixelPlace(first + ivec2(x, y) - 1)]);
        }
        [[unroll]] for (int x = 0; x < 2; ++x) {
            Light middle = row[x + 1];
            rows[y][x] = middle + Real(side.x) * (row[x] - middle) + Real(side.x) * (row[x + 2] - middle);
        }
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int x = i & 1;
        int y = i >> 1;
        vec4 middle = vec4(rows[y + 1][x]);
        add(sums[i], weight,
            middle + side.y * (vec4(rows[y][x]) - middle) + side.y * (vec4(rows[y + 2][x]) - middle));
    }
}

// Level 1, whose texels are the quads: bilinear weights ¼ and ¾ of the 3x3 texels around.
void addFinestLevel(inout Sum sums[4], vec3 weight, ivec2 texel) {
    const Real quarter = Real(0.25);
    Light rows[3][2];
    [[unroll]] for (int y = 0; y < 3; ++y) {
        int index = fineIndex(texel + ivec2(0, y - 1));
        Light middle = storedLight(levelLights[index]);
        rows[y][0] = middle + quarter * (storedLight(levelLights[index - 1]) - middle);
        rows[y][1] = middle + quarter * (storedLight(levelLights[index + 1]) - middle);
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        vec4 middle = vec4(rows[1][i & 1]);
        add(sums[i], weight, mix(middle, vec4(rows[i >> 1 == 0 ? 0 : 2][i & 1]), 0.25));
    }
}

Taps mixTaps(Taps a, Taps b, float fraction) {
    return Taps(mix(a.light, b.light, fraction), mix(a.total, b.total, fraction), mix(a.away, b.away, fraction));
}

// Adds a level with bilinear weights, from 2 on, where the quad's pixels lie between the same four texels.
void addPlainLevel(inout Sum sums[4], vec3 weight, int level, Corner corner) {
    int below = corner.place + levelPitch[level].x;
    float step = 1.0 / float(1 << level);
    vec2 fraction = corner.fraction;
    Light upperLeft = storedLight(levelLights[corner.place]);
    Light lowerLeft = storedLight(levelLights[below]);
    Light upperSlope = storedLight(levelLights[corner.place + 1]) - upperLeft;
    Light lowerSlope = storedLight(levelLights[below + 1]) - lowerLeft;
    [[unroll]] for (int x = 0; x < 2; ++x) {
        Light upper = upperLeft + Real(fraction.x) * upperSlope;
        Light slope = lowerLeft + Real(fraction.x) * lowerSlope - upper;
        add(sums[x], weight, vec4(upper + Real(fraction.y) * slope));
        add(sums[x + 2], weight, vec4(upper + Real(fraction.y + step) * slope));
        fraction.x += step;
    }
}

// The same with depth weights, which the quad's pixels share.
void addWeightedLevel(inout Sum sums[4], vec3 weight, int level, Corner corner, float depth, uint material) {
    float scale = levelScale(level, depth);
    Taps taps[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int place = corner.place + (i & 1) + (i >> 1) * levelPitch[level].x;
        uvec2 surface = levelSurfaces[place - surfaceStart];
        float distance = uintBitsToFloat(surface.x) - depth;
        float tapWeight = surfaceWeight(surface, distance, scale, material);
        taps[i] = Taps(tapWeight * weightedLight(levelLights[place]), tapWeight, tapWeight * distance);
    }
    vec2 fraction = corner.fraction;
    float step = 1.0 / float(1 << level);
    [[unroll]] for (int x = 0; x < 2; ++x) {
        Taps upper = mixTaps(taps[0], taps[1], fraction.x);
        Taps lower = mixTaps(taps[2], taps[3], fraction.x);
        addTaps(sums[x], weight, mixTaps(upper, lower, fraction.y), scale);
        addTaps(sums[x + 2], weight, mixTaps(upper, lower, fraction.y + step), scale);
        fraction.x += step;
    }
}

void addCoarseLevels(inout Sum sums[4], Mixture mixture, ivec2 region, ivec2 first, float depth, uint material) {
    [[dont_unroll]] for (int level = 2; level <= bankLevels; ++level) {
        vec3 weight = kernelWeight(mixture, level + 1);
        if (weight != vec3(0.0)) {
            Corner corner = levelCorner(level, region, first);
            if ((roughLevels >> level & 1u) == 0u) {
                addPlainLevel(sums, weight, level, corner);
            } else {
                addWeightedLevel(sums, weight, level, corner, depth, material);
            }
        }
    }
}

// Fetches everything before anything is used, so that the fetches overlap. Returns the thread's quad.
Quad loadRegion(ivec2 region, int thread, ivec2 texel) {
    ivec2 last = view.areaExtent - 1;
    int fine = texelIndex(1, (region >> 1) + texel);
    uvec2 quadWords = quads[fine];
    uvec2 fineLight = blurredLights[fine];
    ivec2 first = region + 2 * texel;
    vec3 lights[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        lights[i] = fetchLight(min(first + ivec2(i & 1, i >> 1), last));
    }
    int ringThread = threads - 1 - thread;
    ivec2 fineRing = ringPosition(min(ringThread, fineRingCount - 1), fineSize);
    uvec2 ringLight = blurredLights[globalIndex(1, (region >> 1) + fineRing)];
    int level;
    int coarse = coarseIndex(min(thread, coarseCount - 1), region, level);
    uvec2 coarseLight = blurredLights[coarse];
    uvec2 coarseSurface = rawTexels[coarse].zw;
    ivec2 ring = ringPosition(min(thread, ringCount - 1), regionSize);
    Fetched ringPixel = fetchPixel(region, ring);
    Quad quad = unpackQuad(quadWords, materialsOf(quadWords, fine));
    if (hasFlag(flagAlbedo)) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            ivec2 pixel = min(first + ivec2(i & 1, i >> 1), last);
            lights[i] *= albedoBefore(pixel + view.areaOffset, pixelMaterial(quad.materials, ivec2(i & 1, i >> 1)));
        }
    }
    storeLevelTexel(fineIndex(texel), 1, fineLight);
    if (ringThread < fineRingCount) {
        storeLevelTexel(fineIndex(fineRing), 1, ringLight);
    }
    if (thread < coarseCount) {
        storeLevelTexel(fineCount + thread, level, coarseLight);
        storeSurfaces(fineCount + thread, coarse, coarseSurface, coarseLight);
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        storePixel(2 * texel + 1 + offset, lights[i], 0.0, 0.0, pixelMaterial(quad.materials, offset));
    }
    if (thread < ringCount) {
        storeFetched(region, ring, ringPixel);
    }
    return quad;
}

void main() {
    ivec2 region;
    if (!findRegion(0, region)) {
        return;
    }
    int thread = int(gl_LocalInvocationIndex);
    ivec2 texel = ivec2(gl_LocalInvocationID.xy);
    if (thread == 0) {
        roughLevels = 0u;
    }
    barrier();
    Quad quad = loadRegion(region, thread, texel);
    barrier();
    uint ownMaterials[4] =
        uint[](quad.materials.x & 0xffffu, quad.materials.x >> 16, quad.materials.y & 0xffffu, quad.materials.y >> 16);
    ivec2 first = region + 2 * texel;
    ivec2 place = 2 * texel + 1;
    uint scattering = 0u; // bits of the pixels that have a material
    [[unroll]] for (int i = 0; i < 4; ++i) {
        scattering |= ownMaterials[i] != 0u ? 1u << i : 0u;
    }
    // One round for every material in the quad.
    for (uint left = scattering; left != 0u;) {
        uint material = (left & 1u) != 0u   ? ownMaterials[0]
                        : (left & 2u) != 0u ? ownMaterials[1]
                        : (left & 4u) != 0u ? ownMaterials[2]
                                            : ownMaterials[3];
        bvec4 members;
        [[unroll]] for (int i = 0; i < 4; ++i) {
            members[i] = ownMaterials[i] == material;
            left &= members[i] ? ~(1u << i) : ~0u;
        }
        Mixture mixture = findMixture(material, quad.depth, first + view.areaOffset);
        Sum sums[4] = Sum[](noSum, noSum, noSum, noSum);
        addIdentity(sums, mixture, place);
        addSlopePixels(sums, kernelWeight(mixture, 1), place, quad.beside);
        addFinestLevel(sums, kernelWeight(mixture, 2), texel);
        addCoarseLevels(sums, mixture, region, first, quad.depth, material);
        storeGroup(first, place, members, material, mixture.strength, sums);
    }
    if (scattering != 15u) {
        storeRest(first, scattering);
    }
}
