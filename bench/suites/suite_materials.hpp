// Materials with a given number of layers or a given width.
#pragma once

#include "nacre/material.hpp"

namespace nacre::bench {

/// The material with exactly `count` [1 … maxLayers] layers that look much like its own: for fewer, neighbours in
/// variance become one; for more, they repeat at slightly different variances.
Material withLayers(const Material& material, std::size_t count);

/// The material, scaled so that its kernel radius (the width that holds defaultKernelShare of the light) is `radius`
/// mm.
Material withKernelRadius(const Material& material, double radius);

/// The material, scaled so that the rms radius of its widest channel is `radius` mm.
Material withRmsRadius(const Material& material, double radius);

} // namespace nacre::bench
