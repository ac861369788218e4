// The renderer's images, materials and device as the effect's C structs. Internal to the renderer and the benchmark.
#pragma once

#include "nacre/material.hpp"
#include "nacre/nacre.h"
#include "renderer/vulkan/resources.hpp"

namespace nacre::renderer {

/// The image as it was last used.
NacreImage effectImage(const Image& image);
/// The image as a pass finds it after a barrier to `use`.
NacreImage effectImage(const Image& image, const Usage& use);

/// `layers` is where the result's layers point to.
NacreMaterial effectMaterial(const Material& material, std::vector<NacreLayer>& layers);

/// A context's info with the device filled in.
NacreContextInfo effectContextInfo(const Gpu& gpu);

} // namespace nacre::renderer
