// Textures from a function.
#pragma once

#include "scene/scene.hpp"

#include <functional>

namespace nacre::scene::gallery {

/// A square sRGB texture; `color` gives the linear colour at uv in [0, 1]², v downwards.
Texture paint(const char* name, std::uint32_t size, const std::function<glm::vec3(const glm::vec2& uv)>& color);

} // namespace nacre::scene::gallery
