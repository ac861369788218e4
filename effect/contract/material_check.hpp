// A material of the caller's: checked, and as the shaders read it.
#pragma once

#include "technique.hpp"

#include <memory>

namespace nacre::effect {

/// A valid material with what is made of it.
struct CheckedMaterial {
    Material material;
    std::unique_ptr<Profile> profile;
    MaterialParameters parameters;
};

/// Throws an EffectError that names the field, and the material by its id unless that is 0.
CheckedMaterial checkMaterial(const NacreMaterial& material, std::uint32_t id);

} // namespace nacre::effect
