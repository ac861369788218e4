// What C++ and GLSL share of `burley`.
#ifndef NACRE_EFFECT_BURLEY_BLOCKS_H
#define NACRE_EFFECT_BURLEY_BLOCKS_H

#include "interface/blocks.h"

#ifdef __cplusplus
namespace nacre::effect {
#endif

// Tables of `burley`, entry i: R in 1/mm² and share of the light within r = radius·share², share = i / (entries - 1).
// radial's w is r² at which this part of the light within the radius has left in the widest channel: 1 - (1 - share)².
NACRE_CONSTANT burleyEntries = 256;
struct BurleyTable {
    vec4 meanFreePath; // of Burley's profile; r = 0: the profile is in the tables
    uint widest;       // the channel with the largest radius
    float share;       // of its light within the radius
    uint unused0, unused1;
    vec4 radial[burleyEntries];
    vec4 cumulative[burleyEntries];
};

#ifdef __cplusplus
static_assert(offsetof(BurleyTable, radial) == 32 && sizeof(BurleyTable) == 16 * (2 + 2 * burleyEntries));

} // namespace nacre::effect
#endif
#endif
