// Pass C of `bank` for regions with depth discontinuities, or where materials are separate: the same mixture as the smooth
// pipeline's, a pixel a thread, with depth weights tap by tap where surfaces meet. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
const bool isEdge = true;
#include "bank_combine.glsl"

// Fetches everything before anything is used, so that the fetches overlap: one half of the threads level 1 and the pixels
// around, the other the coarser levels. Returns the material of the thread's pixel.
uint loadRegion(ivec2 region, int thread, ivec2 local) {
    Fetched own = fetchPixel(region, local);
    bool isFine = thread < threads / 2;
    int count = isFine ? fineCount : coarseCount;
    int texel = thread % (threads / 2);
    int place = min(texel, count - 1);
    int level = 1;
    int index;
    ivec2 ring = ringPosition(min(thread, ringCount - 1), regionSize);
    Fetched ringPixel;
    if (isFine) {
        index = globalIndex(1, (region >> 1) + ivec2(place % finePitch, place / finePitch) - 1);
        ringPixel = fetchPixel(region, ring);
    } else {
        index = coarseIndex(place, region, level);
        place += fineCount;
    }
    uvec2 light = blurredLights[index];
    uvec2 surface = rawTexels[index].zw;
    if (texel < count) {
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
    float mass = massOf(lightAndArea.w);
    add(sum, weight, vec4(lightAndArea.rgb * (mass / max(lightAndArea.w, bankLeastWeight)), mass));
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

const uint levelKernels = ~3u; // of usedKernels: all but the identity and the full-resolution 3x3

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
        roughLevels = 2u;
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
        addLevels(sums[0], mixture, region, region + local, depth, material);
        storeGroup(region + local, place, bvec4(true), material, mixture.strength, sums);
    } else {
        storeRest(region + local, 0u);
    }
}
