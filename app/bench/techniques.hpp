// The techniques a benchmark compares, by the names the results use.
#pragma once

#include "app/bench/plan.hpp"

namespace nacre::bench {

/// A way to scatter or transmit, at one quality.
struct Variant {
    std::string technique;
    renderer::EffectSettings effect;
    double quality = 0; ///< taps or samples; 0 where the technique has no such setting
};

/// Every scatter technique but the reference, at its default quality, "thesis" also with its kernel compiled in.
/// `radius` [1 … 16] texels is that of the thesis's kernel, which is in scale for this view and size.
std::vector<Variant> scatterVariants(const View& view, const Size& size, std::uint32_t radius);

/// The ways to transmit, scattering off.
std::vector<Variant> transmitVariants();

/// Every scatter technique but the reference, at all its qualities.
std::vector<Variant> qualityVariants(const View& view, const Size& size);

} // namespace nacre::bench
