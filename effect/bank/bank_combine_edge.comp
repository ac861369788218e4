// Pass C of `bank` for regions with depth discontinuities, or where materials are separate: the same mixture as the smooth
// pipeline's, a pixel a thread, with depth weights tap by tap where surfaces meet. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank_region_edge.glsl"
#include "bank_combine.glsl"

// Of level 1's texels as reduced, not packed, since each is read sixteen times: light times area, and area, 0 where it is
// empty; depth, then what addReducedTap wants: what scales squared distances in texel widths, and lightSlope over bankMostLit.
shared vec4 fineTaps[fineCount];
shared vec3 fineSurfaces[fineCount];
const float pixelScale = 0.25 / bankPixelDepthVariance;
shared uint fineMaterials[separateMaterials ? fineCount : 1];
// Of their second surfaces the words of light and area, and depth; 0 where there is none.
shared uvec2 fineSecondLights[secondLevels > 0 ? fineCount : 1];
shared float fineSecondDepths[secondLevels > 0 ? fineCount : 1];
// Of the coarser levels' second surfaces, beside levelLights.
shared uvec2 levelSecondLights[secondLevels > 0 ? coarseRoom : 1];
shared float levelSecondDepths[secondLevels > 0 ? coarseRoom : 1];

void storeFine(int place, int index, uvec4 words) {
    DepthSpread spread = spreadOf(words.zw);
    // What is spread over more depths weighs farther, and less.
    float area = abs(unpackHalf2x16(words.y).y) * sqrt(sqrt(spread.closeness));
    fineTaps[place] = vec4(unpackLight(words.xy).rgb * area, area);
    fineSurfaces[place] =
        vec3(abs(uintBitsToFloat(words.z)), pixelScale * spread.closeness, spread.lightSlope / bankMostLit);
    if (separateMaterials) {
        fineMaterials[place] = materialOf(words.w);
    }
    if (secondLevels > 0) {
        fineSecondDepths[place] = 0.0;
        if (hasSecond(words.w)) {
            uvec4 second = secondTexels[index];
            fineSecondLights[place] = second.xy;
            fineSecondDepths[place] = uintBitsToFloat(second.z);
        }
    }
}

void storeLevelSecond(Coarse coarse, uvec2 surface) {
    levelSecondDepths[coarse.place] = farAway;
    if (hasSecond(surface.y)) {
        uvec4 second = secondTexels[blurredSecondIndex(coarse.index)];
        levelSecondLights[coarse.place] = coarse.beyond ? beyondBorder(second.xy) : second.xy;
        levelSecondDepths[coarse.place] = uintBitsToFloat(second.z);
    }
}

// Returns its material.
uint storeFetched(Region region, ivec2 place, Fetched fetched) {
    uint material = decodeFetched(region, place, fetched);
    float area = fetched.quadArea;
    if (area < 0.0) {
        area = unpackArea(fetched.areas, (fetched.local.x & 1) + 2 * (fetched.local.y & 1));
    }
    bool receives = material != 0u && fetched.depth > 0.0;
    int index = pixelPlace(place + 1);
    storePixel(index, storableLight(fetched.light), area, receives && isFinite(fetched.light));
    pixelDepths[index] = receives ? fetched.depth : 0.0;
    if (separateMaterials) {
        pixelMaterials[index] = material;
    }
    return material;
}

// Fetches everything before anything is used, so that the fetches overlap: one half of the threads the pixels around, the
// other the coarser levels. Returns the material of the thread's pixel.
uint loadRegion(Region region, int thread, ivec2 local) {
    Fetched own = fetchPixel(region, local);
    bool isCoarse = thread >= threads / 2;
    int number = min(thread % (threads / 2), coarseCount - 1);
    Coarse coarse;
    uvec2 light;
    uvec2 surface;
    ivec2 ring = ringPosition(min(thread, ringCount - 1), regionSize);
    Fetched ringPixel;
    if (isCoarse) {
        coarse = findCoarse(number, region.first);
        light = blurredLights[blurredIndex(coarse.index)];
        surface = reducedTexels[coarse.index].zw;
    } else {
        ringPixel = fetchPixel(region, ring);
    }
    int fine = min(thread, fineCount - 1);
    ivec2 fineTexel = ivec2(fine % finePitch, fine / finePitch) - 2;
    int texelPlace = fineTexelIndex(region, fineTexel);
    uvec4 fineWords = reducedTexels[texelPlace];
    if (!readsOccupied(region)) {
        fineWords = isOccupied(region, fineTexel) ? fineWords : uvec4(0u);
        own.quadWord = isOccupied(region, local >> 1) ? own.quadWord : 0u;
        if (!isCoarse && !isOccupied(region, ring >> 1)) {
            ringPixel.quadWord = 0u;
        }
    }
    if (thread < fineCount) {
        storeFine(fine, texelPlace, fineWords);
    }
    if (isCoarse && thread % (threads / 2) < coarseCount) {
        storeLevelTexel(coarse, light);
        uvec2 stored = storeSurface(coarse, surface, light);
        if (separateMaterials) {
            levelMaterials[coarse.place] = materialOf(stored.y);
        }
        if (secondLevels > 0) {
            storeLevelSecond(coarse, surface);
        }
    }
    if (thread < ringCount) {
        storeFetched(region, ring, ringPixel);
    }
    return storeFetched(region, local, own);
}

// Fourth roots of ½ and ¼, the weights along an axis of the middle of the full-resolution 3x3 and of what is beside it.
const float middleRoot = 0.84089642;
const float besideRoot = 0.70710678;

void add(inout Sum sum, vec3 weight, vec4 lightAndCoverage) {
    sum.light[0] += weight * lightAndCoverage.rgb;
    sum.weight += weight * lightAndCoverage.a;
}

// The identity.
void addIdentity(inout Sum sum, vec3 weight, ivec2 local) {
    vec4 lightAndArea = unpackLight(pixelLights[ownPlace(local, ivec2(0))]);
    add(sum, max(weight, vec3(bankLeastIdentity)), vec4(lightAndArea.rgb, coverageOf(lightAndArea.a)));
}

// Light times coverage, and coverage, from light and area that were summed with depth weights over the surface within a
// kernel's reach.
vec4 surfaceSeen(vec4 lightAndArea) {
    float coverage = coverageOf(lightAndArea.w);
    return vec4(lightAndArea.rgb * (coverage / max(lightAndArea.w, bankLeastWeight)), coverage);
}

// The full-resolution 3x3.
void addPixels(inout Sum sum, vec3 weight, ivec2 local, uint material, float depth) {
    float scale = depthScale(texelWidth(0, depth), bankPixelDepthVariance);
    vec4 lightAndArea = vec4(0.0);
    [[unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        int place = ownPlace(local, offset);
        float difference = pixelDepths[place] - depth;
        float root = (offset.x == 0 ? middleRoot : besideRoot) * (offset.y == 0 ? middleRoot : besideRoot);
        vec4 tap = unpackLight(pixelLights[place]);
        float tapWeight = falloffFrom(root - difference * difference * (root * scale)) * tap.a;
        if (separateMaterials) {
            tapWeight = exchanges(pixelMaterials[place], material) ? tapWeight : 0.0;
        }
        lightAndArea += tapWeight * vec4(tap.rgb, 1.0);
    }
    add(sum, weight, surfaceSeen(lightAndArea));
}

// Along an axis the 3x3 mean and the bilinear reading of it, ¼ and ¾, are one kernel of four texels: ¼ ⅓ ⅓ 1/12 for a pixel
// in the second row or column of a quad, from the texel before its own on; for one in the first its mirror image. Here times
// three.
float finestWeight(int i) {
    return i == 0 ? 0.75 : i == 3 ? 0.25 : 1.0;
}

// A texel as reduced: `tap`: light times area, and area; `surface`: fineSurfaces but for the depth. It gives the light that it
// has at the pixel's depth, here over bankMostLit. `distance`: how far it is behind the pixel, in texel widths.
void addReducedTap(inout vec4 lightAndArea, vec4 tap, float kernel, float distance, vec2 surface) {
    float weight = kernel * depthWeight(distance, surface.x);
    float lit = weight * clamp(fma(-surface.y, distance, 1.0 / bankMostLit), 0.0, 1.0);
    lightAndArea += vec4(lit, lit, lit, weight) * tap;
}

// The same of a texel's second surface, which is one depth.
void addSecondTap(inout vec4 lightAndArea, int index, float kernel, float distance) {
    vec4 lightAndOwnArea = unpackLight(fineSecondLights[index]);
    vec4 tap = vec4(lightAndOwnArea.rgb * lightAndOwnArea.a, lightAndOwnArea.a);
    addReducedTap(lightAndArea, tap, kernel, distance, vec2(pixelScale, 0.0));
}

// Level 1, as the pixel sees it.
void addFinestLevel(inout Sum sum, vec3 weight, ivec2 local, float depth, uint material) {
    float perWidth = 1.0 / texelWidth(1, depth);
    float ownDistance = depth * perWidth;
    ivec2 next = 2 * (local & 1) - 1; // which way the kernel goes
    int row = fineIndex((local >> 1) - next);
    vec4 lightAndArea = vec4(0.0);
    [[dont_unroll]] for (int y = 0; y < 4; ++y, row += next.y * finePitch) {
        vec4 rowLightAndArea = vec4(0.0);
        [[unroll]] for (int x = 0; x < 4; ++x) {
            int index = row + x * next.x;
            float kernel = !separateMaterials || exchanges(fineMaterials[index], material) ? finestWeight(x) : 0.0;
            vec3 surface = fineSurfaces[index];
            addReducedTap(rowLightAndArea, fineTaps[index], kernel, fma(surface.x, perWidth, -ownDistance), surface.yz);
            if (secondLevels > 0 && fineSecondDepths[index] > 0.0) {
                addSecondTap(rowLightAndArea, index, kernel, fma(fineSecondDepths[index], perWidth, -ownDistance));
            }
        }
        lightAndArea += finestWeight(y) * rowLightAndArea;
    }
    const float perKernel = 1.0 / 9.0;
    add(sum, weight, surfaceSeen(lightAndArea * vec4(vec3(bankMostLit * perKernel), perKernel)));
}

// Texels of a level, weighted by place and depth, as a pixel sees them.
struct Taps {
    vec4 light; // w: coverage
    float total;
    float away; // mm, how far they are behind the pixel
};

// `distance`: how far the tap is behind the pixel. `scale`: levelScale.
void addTap(inout Taps taps, float bilinear, uvec2 light, float distance, float scale) {
    float weight = bilinear * depthWeight(distance, scale);
    taps.light += weight * levelLight(light);
    taps.total += weight;
    taps.away += weight * distance;
}

// A level with depth weights: light times coverage, and coverage. `scale`: levelScale. `present`: how much of it is where the
// pixel is, [0, 1].
vec4 weightedLevel(float scale, Corner corner, float depth, uint material, out float present) {
    vec2 rest = 1.0 - corner.fraction;
    Taps taps = Taps(vec4(0.0), 0.0, 0.0);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int place = corner.place + (i & 1) + (i >> 1) * levelPitch;
        float bilinear = ((i & 1) == 0 ? rest.x : corner.fraction.x) * (i < 2 ? rest.y : corner.fraction.y);
        if (separateMaterials) {
            bilinear = exchanges(levelMaterials[place], material) ? bilinear : 0.0;
        }
        float distance = levelDepths[place] - depth;
        uvec2 light = levelLights[place];
        if (secondLevels > 0) { // whichever surface is closer
            float other = levelSecondDepths[place] - depth;
            light = abs(other) < abs(distance) ? levelSecondLights[place] : light;
            distance = abs(other) < abs(distance) ? other : distance;
        }
        addTap(taps, bilinear, light, distance, scale);
    }
    float factor = levelFactor(taps.total, taps.away, scale);
    vec4 seen = taps.light * factor;
    present = factor * taps.total;
    return seen;
}

// A level with bilinear weights.
vec4 bilinearLevel(Corner corner) {
    int below = corner.place + levelPitch;
    vec4 upper = mix(unpackLight(levelLights[corner.place]), unpackLight(levelLights[corner.place + 1]), corner.fraction.x);
    vec4 lower = mix(unpackLight(levelLights[below]), unpackLight(levelLights[below + 1]), corner.fraction.x);
    return mix(upper, lower, corner.fraction.y);
}

// From the coarsest level on: the weight of what of a level is not where the pixel is passes to the next finer one. Returns
// what the last of them passes on.
vec3 addLevels(inout Sum sum, Mixture mixture, uint used, ivec2 region, ivec2 local, float depth, uint material) {
    uint stepped = separateMaterials ? ~0u : steppedLevels;
    vec3 passedOn = vec3(0.0);
    float scale = levelScale(bankLevels, depth); // of a finer level four times that, whose texels are half as wide
    [[dont_unroll]] for (int level = bankLevels; level >= 2; --level, scale *= 4.0) {
        if ((used >> level & 2u) == 0u) {
            continue;
        }
        Corner corner = cornerOf(gridOf(level), level, region, local);
        vec4 seen;
        float present = 1.0;
        if ((stepped >> level & 1u) == 0u) {
            seen = bilinearLevel(corner);
        } else {
            seen = weightedLevel(scale, corner, depth, material, present);
        }
        vec3 weight = kernelWeight(mixture, level + 1) + passedOn;
        add(sum, weight, seen);
        passedOn = weight * (1.0 - present);
    }
    return passedOn;
}

void main() {
    Region region;
    if (!findRegion(1, region)) {
        return;
    }
    int thread = int(gl_LocalInvocationIndex);
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    if (thread == 0) {
        steppedLevels = 0u;
    }
    barrier();
    uint material = loadRegion(region, thread, local);
    barrier();
    float depth = pixelDepths[ownPlace(local, ivec2(0))]; // 0 where there is no material
    if (depth > 0.0) {
        ivec2 pixel = region.first + local + view.areaOffset;
        Mixture mixture = findMixture(material, depth, pixel, scaleAt(pixel));
        Sum sum = noSum();
        uint used = usedKernels(mixture);
        vec3 passedOn = addLevels(sum, mixture, used, region.first, local, depth, material);
        if ((used & finestKernel) != 0u) {
            addFinestLevel(sum, kernelWeight(mixture, 2) + passedOn, local, depth, material);
            passedOn = vec3(0.0);
        }
        addPixels(sum, kernelWeight(mixture, 1) + passedOn, local, material, depth);
        addIdentity(sum, kernelWeight(mixture, 0), local);
        storeGroup(region.first + local, bvec4(true), material, strengthOf(mixture), sum);
    } else if (all(lessThan(region.first + local, view.areaExtent))) {
        writeUnscattered(region.first + local + view.areaOffset, material);
    }
}
