// Which technique a call takes.
#pragma once

#include "vulkan/context.hpp"

namespace nacre::effect {

/// The index in `techniques` of a technique the context is made for; throws an EffectError naming `field`.
std::size_t scatterTechniqueIndex(const Context& context, NacreTechnique technique, const char* field);
/// Of that technique or, in its place, of the one that these materials choose (NacreMaterial::secondSurfaces).
std::size_t chosenTechniqueIndex(const Context& context, std::size_t asked, const MaterialTable::Summary& materials);

} // namespace nacre::effect
