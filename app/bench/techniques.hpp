// The techniques a benchmark compares, by the names the results use.
#pragma once

#include "renderer/renderer.hpp"

#include <string>
#include <vector>

namespace nacre::bench {

/// A way to scatter at one quality.
struct Variant {
    std::string technique;
    renderer::EffectSettings effect;
    double quality = 0; ///< taps, samples …; 0 where the technique has no such setting
};

/// Every scatter technique but the reference, at its default quality. `radius` [texels] is the kernel's where the
/// technique counts in texels.
std::vector<Variant> scatterVariants(std::uint32_t radius);

/// The ways to transmit.
std::vector<Variant> transmitVariants();

/// Every scatter technique but the reference, at all its qualities.
std::vector<Variant> qualityVariants();

} // namespace nacre::bench
