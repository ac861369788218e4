// Pass C of `bank` for regions without depth discontinuities: every pixel's mixture of the identity, the
// full-resolution 3x3 and the six blurred levels, with its material's weights. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank_combine.glsl"

const int pairPitch = regionSize.x / 2 + 1;
const int ringCount = 2 * (regionSize.x + 2 + regionSize.y);
const int fineRingCount = 2 * (finePitch + fineSize.y);

// The region's pixels with one around: light, and 1 where a pixel gives light. Even columns, then odd ones, so that
// neighbouring quads read neighbouring places.
shared uvec2 pixelLights[2][pairPitch * (regionSize.y + 2)];

vec3 fetchLight(ivec2 local) {
    return texelFetch(irradianceImage, local + view.areaOffset, 0).rgb;
}

// One of the materials of a quad, whose pixel is at an even or odd place in x and y.
uint quadMaterial(uvec4 quad, ivec2 local) {
    uint words = (local.y & 1) == 0 ? quad.z : quad.w;
    return (local.x & 1) == 0 ? words & 0xffffu : words >> 16;
}

// `place` counts from the pixel up and left of the region's first.
void storePixel(ivec2 place, vec3 light, uint material) {
    bool gives = material != 0u && all(lessThan(abs(light), vec3(1e38)));
    light = min(light, vec3(maxHalf));
    uvec2 words = uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, 1.0)));
    pixelLights[place.x & 1][place.y * pairPitch + (place.x >> 1)] = gives ? words : uvec2(0u);
}

void storeLevelTexel(int index, uvec2 words, int level) {
    levelLights[index] = words;
    if ((words.y & signBit) != 0u) {
        atomicOr(roughLevels, 1u << level);
    }
}

// Fetches everything before anything is used, so that the fetches overlap. Returns the thread's quad.
uvec4 loadRegion(ivec2 region, int thread, ivec2 texel) {
    ivec2 last = view.areaExtent - 1;
    ivec2 fineTexel = (region >> 1) + texel;
    int fine = texelIndex(1, fineTexel);
    uvec4 quad = quads[fine];
    uvec2 fineLight = blurredLights[fine];
    ivec2 near = min(2 * fineTexel, last);
    ivec2 far = min(2 * fineTexel + 1, last);
    vec3 own[4];
    own[0] = fetchLight(near);
    own[1] = fetchLight(ivec2(far.x, near.y));
    own[2] = fetchLight(ivec2(near.x, far.y));
    own[3] = fetchLight(far);
    int ringThread = threads - 1 - thread;
    ivec2 fineRing = ringPosition(min(ringThread, fineRingCount - 1), fineSize);
    uvec2 ringLight = blurredLights[globalIndex(1, (region >> 1) + fineRing)];
    int level;
    uvec2 coarseLight = blurredLights[coarseIndex(min(thread, coarseCount - 1), region, level)];
    ivec2 ring = ringPosition(min(thread, ringCount - 1), regionSize);
    ivec2 ringPixel = clamp(region + ring, ivec2(0), last);
    uvec4 ringQuad = quads[texelIndex(1, ringPixel >> 1)];
    vec3 ringPixelLight = fetchLight(ringPixel);
    uint ringMaterial = ringPixel == region + ring ? quadMaterial(ringQuad, ringPixel) : 0u;
    if (hasFlag(flagAlbedo)) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            ivec2 offset = ivec2(i & 1, i >> 1);
            own[i] *= albedoBefore(min(near + offset, last) + view.areaOffset, quadMaterial(quad, offset));
        }
        ringPixelLight *= albedoBefore(ringPixel + view.areaOffset, ringMaterial);
    }

    storeLevelTexel(fineIndex(texel), fineLight, 1);
    if (ringThread < fineRingCount) {
        storeLevelTexel(fineIndex(fineRing), ringLight, 1);
    }
    if (thread < coarseCount) {
        storeLevelTexel(fineCount + thread, coarseLight, level);
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        storePixel(2 * texel + 1 + offset, own[i], quadMaterial(quad, offset));
    }
    if (thread < ringCount) {
        storePixel(ring + 1, ringPixelLight, ringMaterial);
    }
    return quad;
}

// The identity and the full-resolution 3x3. Taps have the depths of the slope the quad stands on, which makes their
// weights separable: `beside` the middle, in x and y.
void addPixels(inout Sum sums[4], Mixture mixture, ivec2 texel, vec2 beside, out vec4 own[4]) {
    vec4 rows[4][2]; // the block's rows, filtered along x for the quad's two columns
    [[unroll]] for (int y = 0; y < 4; ++y) {
        int place = (2 * texel.y + y) * pairPitch + texel.x;
        vec4 row[4];
        [[unroll]] for (int x = 0; x < 4; ++x) {
            row[x] = unpackLight(pixelLights[x & 1][place + (x >> 1)]);
        }
        [[unroll]] for (int x = 0; x < 2; ++x) {
            rows[y][x] = row[x + 1] + beside.x * (row[x] + row[x + 2]);
            if (y == 1 || y == 2) {
                own[x + 2 * (y - 1)] = row[x + 1];
            }
        }
    }
    vec2 total = 1.0 + 2.0 * beside;
    vec3 identityWeight = kernelWeight(mixture, 0);
    vec3 pixelsWeight = kernelWeight(mixture, 1) / (total.x * total.y);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int x = i & 1;
        int y = i >> 1;
        add(sums[i], identityWeight, own[i]);
        add(sums[i], pixelsWeight, rows[y + 1][x] + beside.y * (rows[y][x] + rows[y + 2][x]));
    }
}

// Level 1, whose texels are the quads: bilinear weights ¼ and ¾ of the 3x3 texels around.
void addFinestLevel(inout Sum sums[4], vec3 weight, ivec2 texel) {
    vec4 rows[3][2];
    [[unroll]] for (int y = 0; y < 3; ++y) {
        int index = fineIndex(texel + ivec2(0, y - 1));
        vec4 middle = unpackLight(levelLights[index]);
        rows[y][0] = mix(middle, unpackLight(levelLights[index - 1]), 0.25);
        rows[y][1] = mix(middle, unpackLight(levelLights[index + 1]), 0.25);
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        add(sums[i], weight, mix(rows[1][i & 1], rows[i >> 1 == 0 ? 0 : 2][i & 1], 0.25));
    }
}

// A level with depth weights, which the quad shares.
void addRoughLevel(inout Sum sums[4], vec3 weight, int level, Corner corner, ivec2 region, ivec2 quad, float depth) {
    float scale = levelScale(level, depth);
    ivec2 first = (quad - (1 << (level - 1))) >> level;
    Tap taps[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        uvec2 surface = blurredSurfaces[globalIndex(level, first + offset)];
        taps[i] = weightedTap(levelLights[corner.index + offset.x + offset.y * levelPitch[level].x], surface, depth,
                              scale, true);
    }
    float step = 1.0 / float(1 << level);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        addTaps(sums[i], weight, taps[0], taps[1], taps[2], taps[3], corner.fraction + vec2(i & 1, i >> 1) * step, scale);
    }
}

void addLevels(inout Sum sums[4], Mixture mixture, ivec2 region, ivec2 quad, float depth) {
    [[unroll]] for (int level = 2; level <= bankLevels; ++level) {
        vec3 weight = kernelWeight(mixture, level + 1);
        if (weight != vec3(0.0)) {
            Corner corner = levelCorner(level, region, quad);
            if ((roughLevels >> level & 1u) == 0u) {
                addPlainLevel(sums, weight, level, corner);
            } else {
                addRoughLevel(sums, weight, level, corner, region, quad, depth);
            }
        }
    }
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
    uvec4 quadWords = loadRegion(region, thread, texel);
    barrier();
    uint quadMaterials[4] =
        uint[](quadWords.z & 0xffffu, quadWords.z >> 16, quadWords.w & 0xffffu, quadWords.w >> 16);
    float depth = uintBitsToFloat(quadWords.x);
    vec2 beside = unpackHalf2x16(quadWords.y);
    ivec2 quad = region + 2 * texel;
    vec3 results[4] = vec3[](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    uint left = 0u; // bits of the pixels that are still to be combined
    [[unroll]] for (int i = 0; i < 4; ++i) {
        left |= quadMaterials[i] != 0u ? 1u << i : 0u;
    }
    // One round for every material in the quad.
    while (left != 0u) {
        uint material = (left & 1u) != 0u   ? quadMaterials[0]
                        : (left & 2u) != 0u ? quadMaterials[1]
                        : (left & 4u) != 0u ? quadMaterials[2]
                                            : quadMaterials[3];
        Mixture mixture = findMixture(material, depth);
        float strength = materials[material].strength;
        Sum sums[4];
        [[unroll]] for (int i = 0; i < 4; ++i) {
            sums[i] = Sum(vec3(0.0), vec3(0.0));
        }
        vec4 own[4];
        addPixels(sums, mixture, texel, beside, own);
        addFinestLevel(sums, kernelWeight(mixture, 2), texel);
        addLevels(sums, mixture, region, quad, depth);
        [[unroll]] for (int i = 0; i < 4; ++i) {
            if (quadMaterials[i] == material) {
                float pixelStrength = own[i].w > 0.0 ? strength * strengthAt(quad + ivec2(i & 1, i >> 1) + view.areaOffset) : 1.0;
                results[i] = mix(own[i].rgb, sums[i].light / max(sums[i].mass, vec3(1e-20)), pixelStrength);
                left &= ~(1u << i);
            }
        }
    }
    storeQuad(quad, quadMaterials, results);
}
