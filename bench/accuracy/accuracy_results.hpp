// How far the pictures of every technique are from the references of every view, as data.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nacre::bench {

/// Errors over some pixels. The peak of PSNR is the reference's largest value.
struct AccuracyFigures {
    std::size_t pixels = 0;
    double psnr = 0; ///< dB; infinite where nothing differs
    /// dB, of the mean squared error less the reference's mean variance, which is what its noise adds to it: what the
    /// picture has against a reference without noise.
    double psnrWithoutNoise = 0;
    /// Too little is left to be told from noise (noiseResolution): psnrWithoutNoise is a lower bound.
    bool isBound = false;
    std::array<double, 3> energy{}; ///< of R, G and B: the picture's sum over the reference's
};

/// An error below this share of the noise's mean square is not told from it, which is 10 dB more than the noise has.
inline constexpr double noiseResolution = 0.1;

/// A technique's picture of a view against one of its references.
struct AccuracyCell {
    std::string technique;
    std::string reference;               ///< AccuracyReference::method
    AccuracyFigures whole;               ///< over the pixels of subsurface materials
    std::optional<AccuracyFigures> thin; ///< over those of them where the body is thin; nothing where there are too few
    double flip = 0;                     ///< mean of HDR-FLIP over the pixels of `whole`
};

/// A reference of a view.
struct AccuracyReference {
    std::string method;   ///< "surface" or "walk"
    double samples = 0;   ///< of a pixel
    double noise = 0;     ///< reference::Film::noise
    double noisePsnr = 0; ///< dB: what a picture without error would have against it
    double seconds = 0;   ///< that it took, in all runs
    std::vector<std::string> warnings;
};

struct AccuracyViewResult {
    std::string name;
    std::string what;
    std::uint32_t shadowMapSize = 0;
    std::vector<AccuracyReference> references;
    std::vector<AccuracyCell> cells;
};

struct AccuracyResults {
    std::string nacreVersion;
    std::string device;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<AccuracyViewResult> views;
};

} // namespace nacre::bench
