// What `thesis` and its baked kernel have in common.
#pragma once

#include "technique.hpp"

namespace nacre::effect {

/// Rows and columns.
extern const Pass thesisMaterialPasses[2];
/// A radius or, for 0, the default; throws an EffectError naming `field`.
std::uint32_t thesisRadius(std::uint32_t radius, const char* field);

} // namespace nacre::effect
