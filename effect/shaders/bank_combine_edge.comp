// Pass C of `bank` for regions with depth discontinuities, or where materials are separate: the same mixture as the smooth
// pipeline's, a pixel a thread, with depth weights tap by tap where surfaces meet. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
const bool isEdge = true;
#include "bank_combine.glsl"

// Of level 1's texels as reduced, beside fineLights: the other two words, and their second surfaces where they have one.
shared uvec2 fineSurfaces[fineCount];
shared uvec4 fineSeconds[secondLevels > 0 ? fineCount : 1];

bool hasFineSecond(int index) {
    return secondLevels > 0 && (fineSurfaces[index].y & secondBit) != 0u;
}

// Fetches everything before anything is used, so that the fetches overlap: one half of the threads the pixels around, the
// other the coarser levels. Returns the material of the thread's pixel.
uint loadRegion(ivec2 region, int thread, ivec2 local) {
    Fetched own = fetchPixel(region, local);
    bool isCoarse = thread >= threads / 2;
    int place = min(thread % (threads / 2), coarseCount - 1);
    int level = 1;
    int index;
    uvec2 light;
    uvec2 surface;
    ivec2 ring = ringPosition(min(thread, ringCount - 1), regionSize);
    Fetched ringPixel;
    if (isCoarse) {
        index = coarseIndex(place, region, level);
        light = blurredLights[blurredIndex(index)];
        surface = rawTexels[index].zw;
    } else {
        ringPixel = fetchPixel(region, ring);
    }
    int fine = min(thread, fineCount - 1);
    ivec2 fineTexel = (region >> 1) + ivec2(fine % finePitch, fine / finePitch) - 2;
    uvec4 words = rawWords(1, fineTexel);
    if (thread < fineCount) {
        fineLights[fine] = words.xy;
        fineSurfaces[fine] = words.zw;
        if (hasFineSecond(fine)) {
            int second = 3 * texelIndex(1, fineTexel);
            fineSeconds[fine] = uvec4(secondTexels[second], secondTexels[second + 1]);
        }
    }
    if (isCoarse && thread % (threads / 2) < coarseCount) {
        storeLevelTexel(place, level, light);
        storeSurfaces(place, index, surface, light);
    }
    if (thread < ringCount) {
        storeFetched(region, ring, ringPixel);
    }
    return storeFetched(region, local, own);
}

// Fourth roots of ½ and ¼, the weights along an axis of the middle of the full-resolution 3x3 and of what is beside it.
const float middleRoot = 0.84089642;
const float besideRoot = 0.70710678;

// Adds a kernel of light and area that were summed with depth weights over the surface within its reach.
void addSurface(inout Sum sum, vec3 weight, vec4 lightAndArea) {
    float mass = massOf(lightAndArea.w);
    add(sum, weight, vec4(lightAndArea.rgb * (mass / max(lightAndArea.w, bankLeastWeight)), mass));
}

// The full-resolution 3x3.
void addPixels(inout Sum sum, vec3 weight, ivec2 middle, uint material, float depth) {
    float width = texelWidth(0, depth);
    float scale = 0.25 / (bankPixelDepthVariance * width * width);
    vec4 lightAndArea = vec4(0.0);
    [[unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        int place = pixelPlace(middle + offset);
        vec4 light = unpackLight(pixelLights[place]);
        bool taken = light.w > 0.0;
        if (separateMaterials) {
            taken = taken && exchanges(pixelMaterials[place], material);
        }
        float difference = taken ? pixelDepths[place] - depth : 1e15;
        float root = (offset.x == 0 ? middleRoot : besideRoot) * (offset.y == 0 ? middleRoot : besideRoot);
        float base = max(0.0, root - difference * difference * (root * scale));
        base *= base;
        lightAndArea += base * base * pixelAreas[place] * vec4(light.rgb, 1.0);
    }
    addSurface(sum, weight, lightAndArea);
}

// Of a pixel in the second row or column of a quad the 3x3 mean and the bilinear reading of it, ¼ and ¾, are this kernel
// along an axis; of one in the first it is the other way round.
const float finestTaps[4] = float[](1.0 / 4.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 12.0);

void addFinestTap(inout vec4 lightAndArea, RawTexel tap, float kernel, float depth, float scale, uint material) {
    float difference = tap.depth - depth;
    float weight = kernel * falloff(difference * difference * scale);
    bool taken = tap.mass > 0.0 && givesLight(tap.material, material);
    lightAndArea += taken ? weight * vec4(tap.light, tap.area) : vec4(0.0);
}

// Level 1, as the pixel sees it.
void addFinestLevel(inout Sum sum, vec3 weight, ivec2 local, float depth, uint material) {
    float width = texelWidth(1, depth);
    float scale = 1.0 / (bankPixelDepthVariance * width * width);
    ivec2 odd = local & 1;
    int first = fineIndex(local / 2 - 2 + odd);
    vec4 lightAndArea = vec4(0.0);
    [[dont_unroll]] for (int y = 0; y < 4; ++y) {
        [[unroll]] for (int x = 0; x < 4; ++x) {
            float kernel = finestTaps[odd.y == 1 ? y : 3 - y] * finestTaps[odd.x == 1 ? x : 3 - x];
            int index = first + y * finePitch + x;
            RawTexel tap = unpackRaw(uvec4(fineLights[index], fineSurfaces[index]));
            addFinestTap(lightAndArea, tap, kernel, depth, scale, material);
            if (hasFineSecond(index)) {
                addFinestTap(lightAndArea, unpackRaw(fineSeconds[index]), kernel, depth, scale, material);
            }
        }
    }
    addSurface(sum, weight, lightAndArea);
}

void addTap(inout Taps taps, float share, uvec2 light, uvec2 surface, float depth, float scale, uint material) {
    float distance = uintBitsToFloat(surface.x) - depth;
    float weight = share * surfaceWeight(surface, distance, scale, material);
    taps.light += weight * weightedLight(light);
    taps.total += weight;
    taps.away += weight * distance;
}

// Adds a level with depth weights.
void addWeightedLevel(inout Sum sum, vec3 weight, int level, Corner corner, float depth, uint material) {
    float scale = levelScale(level, depth);
    vec2 rest = 1.0 - corner.fraction;
    Taps taps = Taps(vec4(0.0), 0.0, 0.0);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int place = corner.place + (i & 1) + (i >> 1) * levelPitch[level].x;
        uvec2 surface = levelSurfaces[place];
        float share = ((i & 1) == 0 ? rest.x : corner.fraction.x) * (i < 2 ? rest.y : corner.fraction.y);
        addTap(taps, share, levelLights[place], surface, depth, scale, material);
        if (hasSecond(place, surface)) {
            addTap(taps, share, secondLights[place], secondSurfaceWords[place], depth, scale, material);
        }
    }
    addTaps(sum, weight, taps, scale);
}

// Adds a level with bilinear weights.
void addPlainLevel(inout Sum sum, vec3 weight, int level, Corner corner) {
    int below = corner.place + levelPitch[level].x;
    vec4 upper = mix(unpackLight(levelLights[corner.place]), unpackLight(levelLights[corner.place + 1]), corner.fraction.x);
    vec4 lower = mix(unpackLight(levelLights[below]), unpackLight(levelLights[below + 1]), corner.fraction.x);
    add(sum, weight, mix(upper, lower, corner.fraction.y));
}

const uint levelKernels = ~7u; // of usedKernels: those of the levels from 2 on

void addLevels(inout Sum sum, Mixture mixture, ivec2 region, ivec2 pixel, float depth, uint material) {
    [[dont_unroll]] for (uint left = usedKernels(mixture) & levelKernels; left != 0u; left &= left - 1u) {
        int level = findLSB(left) - 1;
        vec3 weight = kernelWeight(mixture, level + 1);
        Corner corner = levelCorner(level, region, pixel);
        if ((roughLevels >> level & 1u) == 0u && !separateMaterials) {
            addPlainLevel(sum, weight, level, corner);
        } else {
            addWeightedLevel(sum, weight, level, corner, depth, material);
        }
    }
}

void main() {
    ivec2 region;
    if (!findRegion(1, region)) {
        return;
    }
    int thread = int(gl_LocalInvocationIndex);
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    if (thread == 0) {
        roughLevels = 0u;
    }
    barrier();
    uint material = loadRegion(region, thread, local);
    barrier();
    ivec2 place = local + 1;
    float depth = pixelDepths[pixelPlace(place)]; // 0 where there is no material
    if (depth > 0.0) {
        Mixture mixture = findMixture(material, depth, region + local + view.areaOffset);
        Sum sums[1] = Sum[](noSum);
        addIdentity(sums, mixture, place);
        addPixels(sums[0], kernelWeight(mixture, 1), place, material, depth);
        addFinestLevel(sums[0], kernelWeight(mixture, 2), local, depth, material);
        addLevels(sums[0], mixture, region, region + local, depth, material);
        storeGroup(region + local, place, bvec4(true), material, mixture.strength, sums);
    } else {
        storeRest(region + local, 0u);
    }
}
