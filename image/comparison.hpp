// All that nacre::image says about how far one picture is from another.
#pragma once

#include "image/flip.hpp"
#include "image/metrics.hpp"

#include <array>
#include <optional>

namespace nacre {

/// How FLIP looks at the pictures.
enum class FlipKind {
    Ldr, ///< as a display shows them
    Hdr, ///< at all exposures that show something
};

/// What `count` values say about errors that are to be those of chance: z = difference / standard error each.
struct ChanceTest {
    std::size_t count = 0;  ///< values with a variance above 0
    double beyondShare = 0; ///< [0, 1] share of them beyond 3 standard errors; 0.0027 of normal errors are
    double chiSquared = 0;  ///< Σ z² / count: 1 where the differences are chance, more where they are not
};

/// The share of normally distributed errors beyond 3 standard errors.
inline constexpr double normalBeyondShare = 0.0026998;

/// Tests whether the pixels that count differ by chance. `variance` is that of the values' difference, with channels R,
/// G and B. Throws like channelErrors.
ChanceTest testChance(const Image& image, const Image& reference, const Image& variance, const Mask& mask = {});

struct ComparisonSettings {
    FlipKind flip = FlipKind::Ldr;
    double pixelsPerDegree = defaultPixelsPerDegree;
    double peak = 0; ///< of PSNR and SSIM; 0 = 1 of sRGB encoded images, the 99.9th percentile of linear references
    Mask mask;       ///< which pixels count; empty = all
    Image variance;  ///< of the difference, channels R, G and B; empty = unknown
};

/// How FLIP is distributed over the pixels that count.
struct FlipSummary {
    double mean = 0;
    double median = 0;
    double percentile95 = 0;
    double largest = 0;
};

struct Comparison {
    std::size_t pixels = 0;             ///< that count
    std::size_t notFinite = 0;          ///< values of the test that are NaN or infinite; they count as 0
    std::size_t referenceNotFinite = 0; ///< and of the reference
    FlipSummary flip;
    ExposureRange exposures; ///< of FlipKind::Hdr
    double peak = 0;
    double psnr = 0;                     ///< dB, of the values as they are encoded
    double ssim = 0;                     ///< the same
    double relMse = 0;                   ///< of linear values
    std::array<double, 3> energyRatio{}; ///< of R, G and B, linear
    std::optional<ChanceTest> chance;    ///< where there is a variance
    Image flipMap;                       ///< channel "FLIP"
    Image test;                          ///< what was compared: R, G and B, finite
    Image reference;
};

/// Compares R, G and B of two images of one encoding. Throws std::invalid_argument where sizes, channels or encodings
/// do not fit, or no pixel counts.
Comparison compareImages(const Image& test, const Image& reference, const ComparisonSettings& settings);

} // namespace nacre
