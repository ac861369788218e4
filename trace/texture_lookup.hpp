// Textures as the renderer samples them: bilinear, repeating or clamped, 8-bit sRGB decoded before it is mixed.
#pragma once

#include "scene/scene.hpp"

namespace nacre::trace {

/// The largest mip level's colour at `uv`, linear. The renderer, which sees many texels in a pixel, mixes levels.
glm::vec4 sampleTexture(const scene::Texture& texture, const glm::vec2& uv);

} // namespace nacre::trace
