// What C++ and GLSL share of `thesis`.
#ifndef NACRE_EFFECT_THESIS_BLOCKS_H
#define NACRE_EFFECT_THESIS_BLOCKS_H

#include "interface/blocks.h"

#ifdef __cplusplus
namespace nacre::effect {
#endif

// Table of `thesis`: the slice kernels of radius 1 … thesisMaxRadius, one after the other. Of each, the taps from the
// middle on: weight, and the offset in w. They are symmetric.
NACRE_CONSTANT thesisMaxRadius = 16;
NACRE_CONSTANT thesisTaps = 152;      // = thesisKernelStart(thesisMaxRadius + 1)
NACRE_CONSTANT thesisGroupSize = 128; // pixels of a row per thread group
NACRE_FUNCTION uint thesisKernelStart(uint radius) {
    return (radius - 1u) * (radius + 2u) / 2u;
}

#ifdef __cplusplus
static_assert(thesisKernelStart(1) == 0 && thesisKernelStart(thesisMaxRadius + 1) == thesisTaps);

} // namespace nacre::effect
#endif
#endif
