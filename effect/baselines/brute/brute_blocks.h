// What C++ and GLSL share of `brute`.
#ifndef NACRE_EFFECT_BRUTE_BLOCKS_H
#define NACRE_EFFECT_BRUTE_BLOCKS_H

#include "interface/blocks.h"

#ifdef __cplusplus
namespace nacre::effect {
#endif

// Intermediates (blocks.h).
NACRE_CONSTANT intermediatePixels = 1;

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

#ifdef __cplusplus
static_assert(offsetof(BruteTable, radial) == 16 * (1 + maxLayers) && sizeof(BruteTable) == 16 * 289);
static_assert(sizeof(BrutePixel) == 48);

} // namespace nacre::effect
#endif
#endif
