// An edge region of pass C of `bank`, 16x8 px, one a thread: what lies where in shared memory, and its pixels, with depths,
// areas and materials. docs/scatter.md. Included by the edge pipeline.
#include "bank_region_pass.glsl"

const int ownSide = 1; // there are few such regions, and long threads would leave multiprocessors idle
const ivec2 levelSizes[bankLevels + 1] =
    ivec2[](ivec2(0), ivec2(0), ivec2(6, 4), ivec2(4, 3), ivec2(3, 2), ivec2(2, 2), ivec2(2, 2));
const int levelStart[bankLevels + 2] = int[](0, 0, 0, 24, 36, 42, 46, 50);
// The sheet, a digit a place: the level that lies there.
//
//    0   222222    (four rows of these)
//   24   333355
//   30   333355
//   36   333366
//   42   444.66
//   48   444
const uint packedPlaces = 0u | 24u / 2u << 6 | 42u / 2u << 12 | 28u / 2u << 18 | 40u / 2u << 24;
const int coarseRoom = 51;
const uint regionReads = edgeReads;
#include "bank_region.glsl"

const float levelAwayVariance = secondLevels > 0 ? bankSecondAwayVariance : bankLevelAwayVariance;

// Of pixelLights' pixels: depth, 0 where there is none.
shared float pixelDepths[pixelCount];
shared uint pixelMaterials[separateMaterials ? pixelCount : 1];
// Of levelLights' texels.
shared uint levelMaterials[separateMaterials ? coarseRoom : 1];

// A pixel's place in shared memory, counted from the one up and left of the region's first.
int pixelPlace(ivec2 pixel) {
    return pixel.y * (regionSize.x + 2) + pixel.x;
}

// The same for a pixel that lies so far from a thread's own.
int ownPlace(ivec2 thread, ivec2 offset) {
    return pixelPlace(thread + offset + 1);
}

// `index`: its place in shared memory. `light`: what storableLight leaves as it is. `area`: of its surface, relative to one
// that faces the camera; it weighs so much.
void storePixel(int index, vec3 light, float area, bool gives) {
    uvec2 words = uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, area)));
    pixelLights[index] = gives ? words : uvec2(0u);
}

// A pixel at any place of the region or around it, or the one of the image that is nearest.
struct Fetched {
    ivec2 local;
    int quad; // its texel of level 1
    uint quadWord;
    float quadArea; // negative: the pixels' are in `areas`
    uint areas;
    vec3 light;
    float depth; // along the ray, 0 where nothing was drawn
};

// `place`: counted from the region's first pixel.
Fetched fetchPixel(Region region, ivec2 place) {
    ivec2 local = clamp(region.first + place, ivec2(0), view.areaExtent - 1);
    int quad = fineTexelIndex(region, place >> 1);
    return Fetched(local, quad, reducedTexels[quad].w, unpackHalf2x16(reducedTexels[quad].y).y, quadAreas[quad],
                   fetchLight(local), distanceAlongRay(local + view.areaOffset, viewZ(local + view.areaOffset)));
}

// Makes its light what enters. Returns its material, 0 outside the image.
uint decodeFetched(Region region, ivec2 place, inout Fetched fetched) {
    uint material = pixelMaterial(materialsOf(fetched.quadWord, fetched.quad), fetched.local);
    material = fetched.local == region.first + place ? material : 0u;
    if (hasFlag(flagAlbedoBefore)) {
        fetched.light *= albedoBefore(fetched.local + view.areaOffset, material);
    }
    return material;
}
