// Pass C of `bank` for regions with depth discontinuities, or where materials are separate: the same mixture as the smooth
// pipeline's, a pixel a thread, with depth weights tap by tap where surfaces meet. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
const bool isEdge = true;
#include "bank_combine.glsl"

// Of level 1's texels as reduced, beside fineLights.
shared uvec2 fineSurfaces[fineCount]; // the other two words
shared uvec4 fineSeconds[secondLevels > 0 ? fineCount : 1];

const int pitch = finePitch;

RawTexel texelAt(int index) {
    return unpackRaw(uvec4(fineLights[index], fineSurfaces[index]));
}

float depthAt(int index) {
    return uintBitsToFloat(fineSurfaces[index].x);
}

bool hasSecondAt(int index) {
    return secondLevels > 0 && (fineSurfaces[index].y & secondBit) != 0u;
}

RawTexel secondAt(int index) {
    return unpackRaw(fineSeconds[index]);
}

#include "bank_kernel.glsl"

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
        if (hasSecondAt(fine)) {
            int second = 3 * texelIndex(1, fineTexel);
            fineSeconds[fine] = uvec4(secondTexels[second], secondTexels[second + 1]);
        }
    }
    if (isCoarse && thread % (threads / 2) < coarseCount) {
        place += levelStart[2];
        storeLevelTexel(place, level, light);
        storeSurfaces(place, index, surface, light);
    }
    if (thread < ringCount) {
        storeFetched(region, ring, ringPixel);
    }
    return storeFetched(region, local, own);
}

// Level 1's 3x3 mean at a texel of the region, or around it.
BlurredTexel blurFine(int center, BlurredTexel surface) {
    float width = texelWidth(1, surface.depth);
    Sums sums = Sums(vec3(0.0), 0.0);
    [[dont_unroll]] for (int y = -1; y <= 1; ++y) {
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            addTaps(sums, center + x + y * pitch, surface, 1.0 / 9.0, width);
        }
    }
    divide(surface, sums);
    return surface;
}

// Blurs level 1, a texel a thread; the other half of the threads takes second surfaces.
void blurFineLevel(int thread) {
    int place = thread % (threads / 2);
    if (place >= levelStart[2]) {
        return;
    }
    ivec2 texel = ivec2(place % levelPitch[1].x, place / levelPitch[1].x);
    int center = fineIndex(texel - 1);
    if (thread < threads / 2) {
        BlurredTexel blurred = blurFine(center, findSurface(1, center));
        levelLights[place] = packBlurred(blurred);
        uvec2 own = fineSurfaces[center];
        bool borrows = (own.y & massBits) == 0u && blurred.present;
        levelSurfaces[place] = borrows ? uvec2(floatBitsToUint(blurred.depth), blurred.material << 16 | fullMass) : own;
    } else if (hasSecondAt(center)) {
        BlurredTexel blurred = blurFine(center, findSecond(center));
        secondLights[place] = packBlurred(blurred);
        secondSurfaceWords[place] = fineSeconds[center].zw;
    }
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
    blurFineLevel(thread);
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
