// What the two pipelines of pass C of `bank` know of a region, in shared memory: its pixels, and the texels that they
// read. docs/scatter.md. Needs the constant isEdge: whether depths of pixels and surfaces of texels are loaded, too.
#define BANK_ACCESS readonly
layout(constant_id = 1) const bool albedoOrStrength = true; // else neither image is given, and every material's strength is 1
#define POSSIBLE_FLAGS (albedoOrStrength ? ~0u : ~(flagAlbedo | flagAlbedoBefore | flagStrength))
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

const int threads = 128;
// A thread combines a block of pixels with this side. In edge regions it is one pixel: there are few such regions, and long
// threads would leave multiprocessors idle.
const int ownSide = isEdge ? 1 : 2;
const int ownPixels = ownSide * ownSide;
const ivec2 regionSize = ownSide * partSize; // px
const ivec2 fineSize = regionSize / 2;       // texels of level 1
// Level 1 is loaded as reduced, with two texels around, for its 3x3 mean and to read that bilinearly.
const int finePitch = fineSize.x + 4;
const int fineCount = finePitch * (fineSize.y + 4);
// Of a blurred level a region's pixels read so many texels, from levelFirst on.
const ivec2 levelSizes[bankLevels + 1] =
    isEdge ? ivec2[](ivec2(0), ivec2(0), ivec2(6, 4), ivec2(4, 3), ivec2(3, 2), ivec2(2, 2), ivec2(2, 2))
           : ivec2[](ivec2(0), ivec2(0), ivec2(10, 6), ivec2(6, 4), ivec2(4, 3), ivec2(3, 2), ivec2(2, 2));
// How many a region reads of the levels from 2 on before those of a level.
const int levelStart[bankLevels + 2] =
    isEdge ? int[](0, 0, 0, 24, 36, 42, 46, 50) : int[](0, 0, 0, 60, 84, 96, 102, 106);
const int coarseCount = levelStart[bankLevels + 1];
// In shared memory they lie in one sheet as wide as level 2, the others below it and side by side, so that a place follows
// from its level without tables. Here are the levels' first places, halved, six bits each.
const int levelPitch = levelSizes[2].x;
const uint packedPlaces = isEdge ? 0u | 12u << 6 | 21u << 12 | 14u << 18 | 20u << 24
                                : 0u | 30u << 6 | 33u << 12 | 48u << 18 | 50u << 24;
const int coarseRoom = isEdge ? 51 : 112;

const int pairPitch = regionSize.x / 2 + 1;
const int pairCount = pairPitch * (regionSize.y + 2);
const int pixelCount = 2 * pairCount;
const int ringCount = 2 * (regionSize.x + 2 + regionSize.y);

// The region's pixels with one around: light, and what weighs it, 0 where a pixel gives none: in edge regions the area of its
// surface relative to one that faces the camera, else 1; depth, 0 where there is none.
shared uvec2 pixelLights[pixelCount];
shared float pixelDepths[isEdge ? pixelCount : 1];
shared uint pixelMaterials[isEdge && separateMaterials ? pixelCount : 1];
shared uvec2 levelLights[coarseRoom]; // as blurredLights
// Of the same texels' surfaces. Where none is near, depth is so far that it weighs nothing.
const float farAway = 1e15;
shared float levelDepths[coarseRoom];
shared uint levelMaterials[isEdge && separateMaterials ? coarseRoom : 1];
// Bit l: some texel of level l is not plain, and taps have depth weights of their own; else bilinear ones will do.
shared uint roughLevels;

// What this workgroup combines.
struct Region {
    ivec2 first;   // px of the render area
    uint left;     // ListEntry
    uint occupied; // ListEntry
};

// False where there is none: the last row of a list is not full. Asked after the entry, so that neither waits for the other.
bool findRegion(int kind, out Region region) {
    uint index = gl_WorkGroupID.y * bankDispatchWidth + gl_WorkGroupID.x;
    int place = listPlace(kind, min(index, listCapacity(kind) - 1u));
    ListEntry entry = unpackListEntry(tileEntries[place], tileEntries[place + 1]);
    region = Region(entry.part * partSize, entry.left, entry.occupied);
    BankDispatch dispatch = dispatches[kind];
    return index < max(dispatch.x, dispatch.count); // without a count one row is the list
}

// The first texel of a level in shared memory: the one left of and above the region's first pixel.
ivec2 levelFirst(int level, ivec2 region) {
    return (region - (1 << (level - 1))) >> level;
}

// Of a texel of level 1, counted from the region's first; at the border the nearest.
int fineTexelIndex(Region region, ivec2 texel) {
    return texelIndex(1, clamp((region.first >> 1) + texel, ivec2(0), levelExtent(1) - 1));
}

// Whether all tiles that a region reads hold subsurface pixels. Of level 1 pass A has written nothing in others, and what is
// read there is taken for empty; so are the sides of the image.
bool readsOccupied(Region region) {
    return (region.occupied & ~tileBright) == (isEdge ? edgeReads : smoothReads);
}

// Whether a smooth region might read pixels of which a sum of two differences is more than a half float holds. All its light
// then is half as bright until it is summed.
bool isBright(Region region) {
    return (region.occupied & tileBright) != 0u;
}

// Of the tile of a texel of level 1.
bool isOccupied(Region region, ivec2 texel) {
    ivec2 tile = ((region.first >> 1) + texel >> 3) - (region.first >> 4) + 1;
    return (region.occupied & occupiedBit(tile)) != 0u;
}

// Where the first of the packed levels begins in the sheet.
int placeOf(uint packed) {
    return int(packed & 63u) * 2;
}

// A texel of the levels from 2 on: which one it is of those that the region reads, counted level by level.
struct Coarse {
    int level;
    int place;   // in shared memory
    int index;   // in the pyramid
    bool beyond; // the pyramid's border: there the nearest texel, with bankBorderShare of its light and mass
};

Coarse findCoarse(int number, ivec2 region) {
    int level = 2;
    int width = levelSizes[2].x;
    int start = 0;
    [[unroll]] for (int next = 3; next <= bankLevels; ++next) {
        if (number >= levelStart[next]) {
            level = next;
            width = levelSizes[next].x;
            start = levelStart[next];
        }
    }
    int row = int((float(number - start) + 0.5) / float(width));
    ivec2 place = ivec2(number - start - row * width, row);
    ivec2 texel = levelFirst(level, region) + place;
    ivec2 inside = clamp(texel, ivec2(0), levelExtent(level) - 1);
    return Coarse(level, placeOf(packedPlaces >> 6 * (level - 2)) + place.y * levelPitch + place.x, texelIndex(level, inside),
                  texel != inside);
}

// Of level 1's texels in shared memory; counted from the region's first.
int fineIndex(ivec2 texel) {
    return (texel.y + 2) * finePitch + texel.x + 2;
}

// A pixel's place in shared memory, counted from the one up and left of the region's first. For threads of 2x2 px even
// columns come first, then odd ones, so that neighbouring threads read neighbouring places.
int pixelPlace(ivec2 pixel) {
    return isEdge ? pixel.y * (regionSize.x + 2) + pixel.x
                  : (pixel.x & 1) * pairCount + pixel.y * pairPitch + (pixel.x >> 1);
}

// The same for a pixel that lies so far from the first of a thread's own; what only depends on `offset` is known in advance.
int ownPlace(ivec2 thread, ivec2 offset) {
    if (isEdge) {
        return pixelPlace(thread + offset + 1);
    }
    ivec2 place = offset + 1;
    return (place.x & 1) * pairCount + (place.x >> 1) + place.y * pairPitch + (2 * thread.y * pairPitch + thread.x);
}

vec3 fetchLight(ivec2 local) {
    return texelFetch(irradianceImage, local + view.areaOffset, 0).rgb;
}

// `index`: its place in shared memory. `light`: what storableLight leaves as it is.
void storePixel(int index, vec3 light, float area, bool gives) {
    uvec2 words = uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, isEdge ? area : 1.0)));
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
    return Fetched(local, quad, rawTexels[quad].w, isEdge ? unpackHalf2x16(rawTexels[quad].y).y : 1.0,
                   isEdge ? quadAreas[quad] : 0u, fetchLight(local),
                   isEdge ? distanceAlongRay(local + view.areaOffset, viewZ(local + view.areaOffset)) : 0.0);
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

// The surface of a texel: its own or, where it is empty and light reaches it, the one it has borrowed.
uvec2 surfaceOf(int index, uvec2 own, uvec2 light) {
    if ((own.y & massBits) != 0u || light == uvec2(0u, signBit)) {
        return own;
    }
    uvec2 borrowed = borrowedSurfaces[blurredIndex(index)];
    return uvec2(borrowed.x, borrowed.y << 16 | fullMass);
}

// A blurred texel's words beyond the border.
uvec2 beyondBorder(uvec2 words) {
    return uvec2(packHalf2x16(bankBorderShare * unpackHalf2x16(words.x)),
                 packHalf2x16(bankBorderShare * unpackHalf2x16(words.y)));
}

// Notes whether a level is plain.
void storeLevelTexel(Coarse coarse, uvec2 light) {
    levelLights[coarse.place] = light;
    if (coarse.beyond) {
        levelLights[coarse.place] = beyondBorder(light);
    }
    if ((light.y & signBit) != 0u) {
        atomicOr(roughLevels, 1u << coarse.level);
    }
}

void storeSurface(Coarse coarse, uvec2 own, uvec2 light) {
    uvec2 surface = surfaceOf(coarse.index, own, light);
    levelDepths[coarse.place] = (surface.y & massBits) != 0u ? uintBitsToFloat(surface.x) : farAway;
    if (isEdge && separateMaterials) {
        levelMaterials[coarse.place] = surface.y >> 16;
    }
}
