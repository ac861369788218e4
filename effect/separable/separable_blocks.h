// What C++ and GLSL share of `separable`.
#ifndef NACRE_EFFECT_SEPARABLE_BLOCKS_H
#define NACRE_EFFECT_SEPARABLE_BLOCKS_H

#include "interface/blocks.h"

#ifdef __cplusplus
namespace nacre::effect {
#endif

// Line-spread table of `separable`: entry i is the light between 0 and x = radius·(i / (entries - 1))², so the last
// is half the light within the radius. The square puts entries where narrow layers need them.
NACRE_CONSTANT lineSpreadEntries = 128;

#ifdef __cplusplus
} // namespace nacre::effect
#endif
#endif
