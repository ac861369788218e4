// Tier 1: what every screen-space method approximates, in double precision. Σ R·dA·E / Σ R·dA over all pixels that
// scatter, with the distance between surface points in space and the receiver's profile.
#pragma once

#include "tests/support/synthetic_scenes.hpp"

namespace nacre::tests {

struct ReferencePixel {
    int x = 0;
    int y = 0;
    Rgb value{};
};

/// Every `stride`-th scattering pixel of every `stride`-th row, shifted from row to row so that no column is left out.
/// R is integrated within the pixels around the receiver, sampled at pixel centres further out.
std::vector<ReferencePixel> scatterReference(const ScatterScene& scene, int stride);

/// dB, peak 1, of an image at the reference's pixels.
double psnr(const ScatterScene& scene, std::span<const ReferencePixel> reference, std::span<const Rgb> image);
double largestError(const ScatterScene& scene, std::span<const ReferencePixel> reference, std::span<const Rgb> image);

} // namespace nacre::tests
