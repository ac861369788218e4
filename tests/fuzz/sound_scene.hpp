// What the renderer takes for granted in a scene.
#pragma once

#include "scene/scene.hpp"

namespace nacre::fuzz {

/// Ends the process with a message unless every index of the scene is in range, every texture has its pixels, every
/// material is valid, and every number is finite.
void requireSound(const scene::Scene& scene);

} // namespace nacre::fuzz
