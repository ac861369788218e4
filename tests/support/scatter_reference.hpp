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

/// How finely, and how far.
struct ScatterReferenceSettings {
    double reachShare = 0.9995; ///< what lies beyond the radius of this share of the widest channel's light is left out
    int nearField = 3;          ///< [px] half width of the square in which R is integrated over the pixels
    int subSamples = 6;         ///< per axis, of a pixel in it
    /// The patches that pixels see are `brute`'s, which heeds depth at silhouettes; else those of the exact normals.
    bool patchesOfBrute = false;
};

/// What technique `brute` computes, its near patches integrated more finely than it does.
inline constexpr ScatterReferenceSettings asBrute{
    .reachShare = 0.999, .nearField = 4, .subSamples = 16, .patchesOfBrute = true};

/// Every `stride`-th scattering pixel of every `stride`-th row, shifted from row to row so that no column is left out.
/// R is integrated within the pixels around the receiver, sampled at pixel centres further out.
std::vector<ReferencePixel> scatterReference(const ScatterScene& scene, int stride,
                                             const ScatterReferenceSettings& settings = {});

/// dB, peak 1, of an image at the reference's pixels.
double psnr(const ScatterScene& scene, std::span<const ReferencePixel> reference, std::span<const Rgb> image);
double largestError(const ScatterScene& scene, std::span<const ReferencePixel> reference, std::span<const Rgb> image);

} // namespace nacre::tests
