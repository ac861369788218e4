// What of a model is blended when it is drawn.
#pragma once

#include "scene/scene.hpp"

#include <filesystem>

namespace nacre::scene {

/// Leaves AlphaMode::Blend to surfaces that can be blended. Those that are opaque everywhere (many exporters call every
/// surface blended) become opaque. Those that have a subsurface material become masked, with a note that begins with
/// `file`: light scatters in bodies, which the camera's images hold.
void settleBlending(Scene& scene, const std::filesystem::path& file);

} // namespace nacre::scene
