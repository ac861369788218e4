// The synthetic scenes of tests/support as inputs of the effect.
#pragma once

#include "tests/gpu/support/effect.hpp"
#include "tests/support/synthetic_scenes.hpp"

namespace nacre::tests {

/// The scene's G-buffer, with normals when asked for.
ScatterInput toInput(const ScatterScene& scene, bool normals = false);
/// The red, green and blue of an image.
std::vector<Rgb> toRgb(std::span<const Float4> image);

} // namespace nacre::tests
