// Loading a region into shared memory, for both pipelines of pass C of `bank`: 32x16 px a workgroup, a 2x2 quad a thread.
// docs/scatter.md. Needs the constant isEdge: whether depths of pixels and surfaces of texels are loaded, too.
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

// In edge regions the levels up to this one are read from every pixel's own depth, the others from the quad's first pixel's.
const int ownDepthLevels = secondLevels > 0 ? 2 : 1;
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

const int pairPitch = regionSize.x / 2 + 1;
const int pairCount = pairPitch * (regionSize.y + 2);
const int ringCount = 2 * (regionSize.x + 2 + regionSize.y);
const int fineRingCount = 2 * (finePitch + fineSize.y);

// The region's pixels with one around: light, and 1 where a pixel gives light; depth, 0 where there is none. Even
// columns, then odd ones, so that neighbouring quads read neighbouring places.
shared uvec2 pixelLights[2 * pairCount];
shared float pixelDepths[isEdge ? 2 * pairCount : 1];
shared float pixelAreas[isEdge ? 2 * pairCount : 1]; // of the surface, relative to one that faces the camera
shared uint pixelMaterials[isEdge && separateMaterials ? 2 * pairCount : 1];
shared uvec2 levelLights[levelTexelCount]; // as blurredLights
// Depth, and a raw texel's last word: mass (0 = no surface near) and material.
shared uvec2 fineSurfaces[isEdge ? fineCount : 1];
shared uvec2 coarseSurfaces[coarseCount];
// As levelLights and their surfaces, of the texels that have a second one (secondBit).
const int secondCount = levelStart[bankSecondLevels + 1];
shared uvec2 secondLights[isEdge && secondLevels > 0 ? secondCount : 1];
shared uvec2 secondSurfaceWords[isEdge && secondLevels > 0 ? secondCount : 1];
// Bit l: some texel of level l is not plain, and taps have depth weights of their own; else bilinear ones will do.
shared uint roughLevels;

// The region that this workgroup combines, in px of the render area; false where there is none.
bool findRegion(int kind, out ivec2 region) {
    uint entry = gl_WorkGroupID.y * bankDispatchWidth + gl_WorkGroupID.x;
    if (gl_NumWorkGroups.y > 1u && entry >= dispatches[kind].count) { // the last row is not full
        return false;
    }
    int index = int(tileEntries[regionList(kind) + int(entry)]);
    int width = regionCount().x;
    region = ivec2(index % width, index / width) * regionSize;
    return true;
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

// A pixel's place in shared memory, counted from the one up and left of the region's first.
int pixelPlace(ivec2 pixel) {
    return (pixel.x & 1) * pairCount + pixel.y * pairPitch + (pixel.x >> 1);
}

struct Fetched {
    vec3 light;
    float z;
};

Fetched fetchPixel(ivec2 local) {
    ivec2 pixel = local + view.areaOffset;
    return Fetched(texelFetch(irradianceImage, pixel, 0).rgb, isEdge ? viewZ(pixel) : 0.0);
}

void storePixel(ivec2 pixel, Fetched fetched, uint material, float area) {
    bool receives = material != 0u && (!isEdge || isValidZ(fetched.z));
    bool gives = receives && isFinite(fetched.light);
    vec3 light = min(fetched.light, vec3(maxHalf));
    int place = pixelPlace(pixel);
    uvec2 words = uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, 1.0)));
    pixelLights[place] = gives ? words : uvec2(0u);
    if (isEdge) {
        pixelDepths[place] = receives ? -fetched.z : 0.0;
        pixelAreas[place] = area;
    }
    if (isEdge && separateMaterials) {
        pixelMaterials[place] = material;
    }
}

// The surface of a texel: its own or, where it is empty and light reaches it, the one it has borrowed.
uvec2 surfaceOf(int index, uvec2 own, uvec2 light) {
    if ((own.y & massBits) != 0u || light == uvec2(0u, signBit)) {
        return own;
    }
    uvec2 borrowed = borrowedSurfaces[index];
    return uvec2(borrowed.x, borrowed.y << 16 | fullMass);
}

// A texel beside the region may be rough through what lies beyond it; those of level 1 are read all the same.
void storeFinestTexel(int index, uvec2 light) {
    levelLights[index] = uvec2(light.x, light.y & ~signBit);
}

void storeLevelTexel(int index, int level, uvec2 light) {
    levelLights[index] = light;
    if ((light.y & signBit) != 0u) {
        atomicOr(roughLevels, 1u << level);
    }
}

// Whether a texel, whose place in shared memory and surface these are, has a second one there.
bool hasSecond(int place, uvec2 surface) {
    return isEdge && secondLevels > 0 && place < secondCount && (surface.y & secondBit) != 0u;
}

// A texel's surface, and its second one in edge regions. `index`: in the pyramid; `place`: in shared memory.
uvec2 loadSurfaces(int index, int place, uvec2 own, uvec2 light) {
    if (hasSecond(place, own)) {
        secondSurfaceWords[place] = secondTexels[3 * index + 1];
        secondLights[place] = secondTexels[3 * index + 2];
    }
    return surfaceOf(index, own, light);
}

// Fetches everything before anything is used, so that the fetches overlap. Returns the thread's quad.
Quad loadRegion(ivec2 region, int thread, ivec2 texel) {
    ivec2 last = view.areaExtent - 1;
    ivec2 fineTexel = (region >> 1) + texel;
    int fine = texelIndex(1, fineTexel);
    uvec2 quadWords = quads[fine];
    uint areas = isEdge ? quadAreas[fine] : 0u;
    uvec2 fineLight = blurredLights[fine];
    uvec2 fineSurface = isEdge ? rawTexels[fine].zw : uvec2(0u);
    ivec2 near = min(2 * fineTexel, last);
    ivec2 far = min(2 * fineTexel + 1, last);
    Fetched own[4] = Fetched[](fetchPixel(near), fetchPixel(ivec2(far.x, near.y)), fetchPixel(ivec2(near.x, far.y)),
                               fetchPixel(far));
    int ringThread = threads - 1 - thread;
    ivec2 fineRing = ringPosition(min(ringThread, fineRingCount - 1), fineSize);
    int ringIndex = globalIndex(1, (region >> 1) + fineRing);
    uvec2 ringLight = blurredLights[ringIndex];
    uvec2 ringSurface = isEdge ? rawTexels[ringIndex].zw : uvec2(0u);
    int level;
    int coarse = coarseIndex(min(thread, coarseCount - 1), region, level);
    uvec2 coarseLight = blurredLights[coarse];
    uvec2 coarseSurface = rawTexels[coarse].zw;
    ivec2 ring = ringPosition(min(thread, ringCount - 1), regionSize);
    ivec2 ringPixel = clamp(region + ring, ivec2(0), last);
    int ringQuadIndex = texelIndex(1, ringPixel >> 1);
    uvec2 ringQuad = quads[ringQuadIndex];
    uint ringAreas = isEdge ? quadAreas[ringQuadIndex] : 0u;
    Fetched ringFetched = fetchPixel(ringPixel);
    Quad quad = unpackQuad(quadWords, materialsOf(quadWords, fine));
    uint ringMaterial = pixelMaterial(materialsOf(ringQuad, ringQuadIndex), ringPixel);
    ringMaterial = ringPixel == region + ring ? ringMaterial : 0u;
    if (hasFlag(flagAlbedo)) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            ivec2 offset = ivec2(i & 1, i >> 1);
            own[i].light *= albedoBefore(min(near + offset, last) + view.areaOffset, pixelMaterial(quad.materials, offset));
        }
        ringFetched.light *= albedoBefore(ringPixel + view.areaOffset, ringMaterial);
    }

    storeFinestTexel(fineIndex(texel), fineLight);
    if (ringThread < fineRingCount) {
        storeFinestTexel(fineIndex(fineRing), ringLight);
    }
    if (thread < coarseCount) {
        storeLevelTexel(fineCount + thread, level, coarseLight);
        coarseSurfaces[thread] = loadSurfaces(coarse, fineCount + thread, coarseSurface, coarseLight);
    }
    if (isEdge) {
        fineSurfaces[fineIndex(texel)] = loadSurfaces(fine, fineIndex(texel), fineSurface, fineLight);
        if (ringThread < fineRingCount) {
            fineSurfaces[fineIndex(fineRing)] = loadSurfaces(ringIndex, fineIndex(fineRing), ringSurface, ringLight);
        }
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        storePixel(2 * texel + 1 + offset, own[i], pixelMaterial(quad.materials, offset), unpackAreas(areas)[i]);
    }
    if (thread < ringCount) {
        float ringArea = unpackAreas(ringAreas)[(ringPixel.x & 1) + 2 * (ringPixel.y & 1)];
        storePixel(ring + 1, ringFetched, ringMaterial, ringArea);
    }
    return quad;
}
