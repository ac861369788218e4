// How far a picture is from its reference: PSNR, relMSE, the ratio of energies, and SSIM. FLIP is in flip.hpp.
#pragma once

#include "image/image.hpp"

#include <cstdint>

namespace nacre {

/// What relMSE adds to a squared reference value, so that dark pixels do not count without bound: 0.01, as Rousselle et
/// al. 2011 (Adaptive Sampling and Reconstruction using Greedy Error Minimization, section 6) do.
inline constexpr double relMseEpsilon = 0.01;

/// Peak signal-to-noise ratio, dB: 10·log₁₀(peak² / mean squared error); infinite where there is no error.
double psnr(double meanSquaredError, double peak);

/// The sums over values and their references that metrics are made of. Values that are not finite make them so.
class ErrorSums {
public:
    void add(double value, double reference) {
        const double squared = (value - reference) * (value - reference);
        squares_ += squared;
        relativeSquares_ += squared / (reference * reference + relMseEpsilon);
        valueSum_ += value;
        referenceSum_ += reference;
        ++count_;
    }
    ErrorSums& operator+=(const ErrorSums& other);

    std::size_t count() const { return count_; }
    /// NaN where nothing was added, as of the others.
    double meanSquaredError() const { return squares_ / static_cast<double>(count_); }
    /// dB, for a stated peak: the value that counts as full.
    double psnr(double peak) const { return nacre::psnr(meanSquaredError(), peak); }
    /// The mean of (value − reference)² / (reference² + relMseEpsilon).
    double relMse() const { return relativeSquares_ / static_cast<double>(count_); }
    /// Σ value / Σ reference; 1 where both are 0.
    double energyRatio() const { return valueSum_ == referenceSum_ ? 1 : valueSum_ / referenceSum_; }

private:
    std::size_t count_ = 0;
    double squares_ = 0;
    double relativeSquares_ = 0;
    double valueSum_ = 0;
    double referenceSum_ = 0;
};

/// Throws std::invalid_argument, saying what differs, unless both images have the same size and channels.
void requireAlike(const Image& image, const Image& reference);

/// Which pixels count: one that is not 0 each. Empty: all do.
using Mask = std::vector<std::uint8_t>;

/// How many pixels of the image count.
std::size_t countedPixels(const Image& image, const Mask& mask);

/// The sums of every channel over the pixels that count. Throws std::invalid_argument unless both images have the same
/// size and channels, and the mask is empty or has their size.
std::vector<ErrorSums> channelErrors(const Image& image, const Image& reference, const Mask& mask = {});

/// The same over all channels at once.
ErrorSums errors(const Image& image, const Image& reference, const Mask& mask = {});

/// The value that `share` [0, 1] of the values of pixels that count do not exceed; 0 where none counts. 1 is the
/// largest.
double quantile(const Image& image, double share, const Mask& mask = {});

/// Structural similarity (Wang et al. 2004) of every pixel, the mean over the channels: 1 channel "SSIM" in [−1, 1].
/// Windows of 11 x 11 pixels, Gaussian of 1.5 pixels; K₁ = 0.01, K₂ = 0.03 of `peak`. At the border of an image its
/// last pixels repeat. Throws like channelErrors.
Image ssimMap(const Image& image, const Image& reference, double peak);

/// The mean over the pixels that count of the channels of a map.
double mean(const Image& map, const Mask& mask = {});

} // namespace nacre
