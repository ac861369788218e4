// What both pipelines of pass C of `bank` know of a region, in shared memory: the light of its pixels, and the texels of the
// levels from 2 on that they read. docs/scatter.md. Included by bank_region_smooth.glsl and bank_region_edge.glsl, after
// bank_region_pass.glsl, when they have defined
//   ownSide                 px: a thread combines a square of pixels with this side
//   levelSizes, levelStart  of a level from 2 on: the texels that a region's pixels read, and how many it reads before them
//   packedPlaces            where in the sheet levels 2 to 6 begin (below), halved, six bits each
//   coarseRoom              how many places the sheet has
//   regionReads             bits of the tiles that a region reads (occupiedBit)

const int ownPixels = ownSide * ownSide;
const ivec2 regionSize = ownSide * partSize; // px
const ivec2 fineSize = regionSize / 2;       // texels of level 1
// Level 1 is loaded as reduced, with two texels around, for its 3x3 mean and to read that bilinearly.
const int finePitch = fineSize.x + 4;
const int fineCount = finePitch * (fineSize.y + 4);
const int coarseCount = levelStart[bankLevels + 1];
// In shared memory the levels from 2 on lie in one sheet as wide as level 2, the others below it and side by side, so that a
// place follows from its level without tables.
const int levelPitch = levelSizes[2].x;

const int pairPitch = regionSize.x / 2 + 1;
const int pairCount = pairPitch * (regionSize.y + 2);
const int pixelCount = 2 * pairCount;
const int ringCount = 2 * (regionSize.x + 2 + regionSize.y);

// The region's pixels with one around: light, and what weighs it, 0 where a pixel gives none.
shared uvec2 pixelLights[pixelCount];
shared uvec2 levelLights[coarseRoom]; // as blurredLights
// Of the same texels' surfaces. Where none is near, depth is so far that it weighs nothing.
const float farAway = 1e15;
shared float levelDepths[coarseRoom];
// Bit l: a texel of level l has steppedBit, and taps have depth weights of their own; else bilinear ones will do.
shared uint steppedLevels;

// What this workgroup combines.
struct Region {
    ivec2 first;   // px of the render area
    uint skipped;  // ListEntry
    uint occupied; // ListEntry
};

// False where there is none: the last row of a list is not full. Asked after the entry, so that neither waits for the other.
bool findRegion(int kind, out Region region) {
    uint index = gl_WorkGroupID.y * bankDispatchWidth + gl_WorkGroupID.x;
    int place = listPlace(kind, min(index, listCapacity(kind) - 1u));
    ListEntry entry = unpackListEntry(tileEntries[place], tileEntries[place + 1]);
    region = Region(entry.part * partSize, entry.skipped, entry.occupied);
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
    return (region.occupied & ~tileBright) == regionReads;
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
    bool beyond; // the pyramid's border: there the nearest texel, with bankBorderShare of its light and coverage
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

vec3 fetchLight(ivec2 local) {
    return texelFetch(irradianceImage, local + view.areaOffset, 0).rgb;
}

// The surface of a texel: its own or, where it is empty and light reaches it, the one it has borrowed.
uvec2 surfaceOf(int index, uvec2 own, uvec2 light) {
    if (isCovered(own.y) || light == uvec2(0u, steppedBit)) {
        return own;
    }
    uvec2 borrowed = borrowedSurfaces[blurredIndex(index)];
    return uvec2(borrowed.x, borrowed.y << 16 | fullCoverage);
}

// A blurred texel's words beyond the border.
uvec2 beyondBorder(uvec2 words) {
    return uvec2(packHalf2x16(bankBorderShare * unpackHalf2x16(words.x)),
                 packHalf2x16(bankBorderShare * unpackHalf2x16(words.y)));
}

// Notes whether bilinear weights will do for the level.
void storeLevelTexel(Coarse coarse, uvec2 light) {
    levelLights[coarse.place] = light;
    if (coarse.beyond) {
        levelLights[coarse.place] = beyondBorder(light);
    }
    if ((light.y & steppedBit) != 0u) {
        atomicOr(steppedLevels, 1u << coarse.level);
    }
}

// Of a texel of a level from 2 on, given the last two of its reduced words and its blurred ones: returns the surface's.
uvec2 storeSurface(Coarse coarse, uvec2 own, uvec2 light) {
    uvec2 surface = surfaceOf(coarse.index, own, light);
    levelDepths[coarse.place] = isCovered(surface.y) ? uintBitsToFloat(surface.x) : farAway;
    return surface;
}
