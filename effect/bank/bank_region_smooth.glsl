// A smooth region of pass C of `bank`, 32x16 px, 2x2 a thread: what lies where in shared memory, and its pixels.
// docs/scatter.md. Included by the smooth pipeline.
#include "bank_region_pass.glsl"

const int ownSide = 2;
const ivec2 levelSizes[bankLevels + 1] =
    ivec2[](ivec2(0), ivec2(0), ivec2(10, 6), ivec2(6, 4), ivec2(4, 3), ivec2(3, 2), ivec2(2, 2));
const int levelStart[bankLevels + 2] = int[](0, 0, 0, 60, 84, 96, 102, 106);
// The sheet, a digit a place: the level that lies there.
//
//    0   2222222222    (six rows of these)
//   60   3333334444
//   70   3333334444
//   80   3333334444
//   90   333333555.
//  100   66....555.
//  110   66
const uint packedPlaces = 0u | 60u / 2u << 6 | 66u / 2u << 12 | 96u / 2u << 18 | 100u / 2u << 24;
const int coarseRoom = 112;
const uint regionReads = smoothReads;
#include "bank_region.glsl"

const float levelAwayVariance = bankLevelAwayVariance;

// Whether a smooth region might read pixels of which a sum of two differences is more than a half float holds. All its light
// then is half as bright until it is summed.
bool isBright(Region region) {
    return (region.occupied & tileBright) != 0u;
}

// A pixel's place in shared memory, counted from the one up and left of the region's first. Even columns come first, then odd
// ones, so that neighbouring threads, of 2x2 px, read neighbouring places.
int pixelPlace(ivec2 pixel) {
    return (pixel.x & 1) * pairCount + pixel.y * pairPitch + (pixel.x >> 1);
}

// The same for a pixel that lies so far from the first of a thread's own; what only depends on `offset` is known in advance.
int ownPlace(ivec2 thread, ivec2 offset) {
    ivec2 place = offset + 1;
    return (place.x & 1) * pairCount + (place.x >> 1) + place.y * pairPitch + (2 * thread.y * pairPitch + thread.x);
}

// `index`: its place in shared memory. `light`: what storableLight leaves as it is. All pixels weigh the same.
void storePixel(int index, vec3 light, bool gives) {
    uvec2 words = uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, 1.0)));
    pixelLights[index] = gives ? words : uvec2(0u);
}

// A pixel at any place of the region or around it, or the one of the image that is nearest.
struct Fetched {
    ivec2 local;
    int quad; // its texel of level 1
    uint quadWord;
    vec3 light;
};

// `place`: counted from the region's first pixel.
Fetched fetchPixel(Region region, ivec2 place) {
    ivec2 local = clamp(region.first + place, ivec2(0), view.areaExtent - 1);
    int quad = fineTexelIndex(region, place >> 1);
    return Fetched(local, quad, reducedTexels[quad].w, fetchLight(local));
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
