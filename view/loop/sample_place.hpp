// Where in its pixel a sample lies, and how large a pixel is.
#pragma once

#include "scene/scene.hpp"

namespace nacre::view {

/// [-0.5, 0.5) px Where in its pixel sample `index` of a picture lies: the first in the middle, the others spread
/// evenly.
glm::vec2 jitterOf(std::uint32_t index);

/// SampleLook::pixelScale of ShownImage::Footprint: px per mm at a depth of 1 scene unit; negative: at
/// every depth.
float pixelsPerMillimeter(const scene::Camera& camera, std::uint32_t height, float metersPerUnit);

/// The same of ShownImage::Regions: the width of a pixel there, scene units.
float pixelWidth(const scene::Camera& camera, std::uint32_t height);

} // namespace nacre::view
