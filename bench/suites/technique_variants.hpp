// The techniques a benchmark compares, by the names the results use.
#pragma once

#include "bench/suites/suite_plan.hpp"

namespace nacre::bench {

/// A way to scatter or transmit.
struct Variant {
    std::string technique;
    renderer::EffectSettings effect;
};

/// A technique at one quality.
struct QualityVariant {
    Variant variant;
    double quality = 0;
    std::string unit; ///< of `quality`
    Size size;        ///< of the picture it renders
};

/// Every scatter technique but the reference, at its default quality, "thesis" also with its kernel compiled in. No
/// material of a suite asks for second surfaces, so that "bank-surfaces", which keeps them everywhere, is left out as
/// well. `radius` [1 … 16] texels is that of the thesis's kernel, which is in scale for this view and size.
std::vector<Variant> scatterVariants(const View& view, const Size& size, std::uint32_t radius);

/// The ways to transmit, scattering off.
std::vector<Variant> transmitVariants();

/// Every scatter technique but the reference, at all its qualities. What has no setting of its own has the resolution:
/// the picture is rendered at a share of `size`, as with dynamic resolution.
std::vector<QualityVariant> qualityVariants(const View& view, const Size& size);

} // namespace nacre::bench
