// What C++ and GLSL share of `brute`.
#ifndef NACRE_EFFECT_BRUTE_BLOCKS_H
#define NACRE_EFFECT_BRUTE_BLOCKS_H

#include "interface/blocks.h"

#ifdef __cplusplus
namespace nacre::effect {
#endif

// Intermediates (blocks.h).
NACRE_CONSTANT intermediatePixels = 1;
NACRE_CONSTANT intermediateSums = 10;

// Radial table of `brute`: entry i is R(r) in 1/mm² at r = radius·(i / (entries - 1))²; used from bruteCellRadius px on.
NACRE_CONSTANT radialEntries = 256;
struct BruteTable {
    vec4 meanFreePath; // w: number of layers; 0 = Burley's profile
    vec4 layers[maxLayers];
    vec4 radial[radialEntries];
};
struct BrutePixel {
    vec4 light;    // irradiance; w: surface area in mm², 0 = contributes nothing
    vec4 position; // view space, mm; w: material id
    vec2 slope;    // of its patch, mm of view z per pixel in x and y
    vec2 unused;
};
// The sums of a receiver between two dispatches of the gather; w is unused.
struct BruteSum {
    vec4 light;
    vec4 weight;
};
// One dispatch of the gather adds a band of this many rows of the area to every receiver. Mesa's software device ends
// all loops of an invocation, without a word, after 65,535 turns in total; and a short dispatch does not keep a display
// waiting. A band takes at most 32,768 turns: a row is its pixels, the turn that ends it, and one of the outer loop. The
// patches around the receiver, which belong to the first band, take at most 31,800 with maxLayers layers, and 21,000 with
// Burley's profile.
NACRE_FUNCTION uint bruteBandRows(uint areaWidth) {
    return areaWidth < 32768u - 2u ? 32768u / (areaWidth + 2u) : 1u;
}

#ifdef __cplusplus
static_assert(offsetof(BruteTable, radial) == 16 * (1 + maxLayers) && sizeof(BruteTable) == 16 * 289);
static_assert(sizeof(BrutePixel) == 48 && sizeof(BruteSum) == 32);

} // namespace nacre::effect
#endif
#endif
