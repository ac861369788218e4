// The samples of a picture, summed, and what they say.
#pragma once

#include "reference/estimator.hpp"

#include <vector>

namespace nacre::reference {

/// Sums over one pixel's samples.
struct PixelSum {
    glm::dvec3 sum{0};
    glm::dvec3 squares{0};
    std::uint32_t count = 0;

    void add(const glm::dvec3& value) {
        sum += value;
        squares += value * value;
        ++count;
    }
    glm::dvec3 mean() const { return count > 0 ? sum / static_cast<double>(count) : glm::dvec3(0); }
    /// Of the mean; infinite below two samples.
    glm::dvec3 variance() const;

    bool operator==(const PixelSum&) const = default;
};

/// A share of a picture's pixels. All shares together are the picture, each pixel in one.
struct Part {
    std::uint32_t index = 1; ///< [1 … count]
    std::uint32_t count = 1; ///< [≥ 1]

    /// Pixels are dealt out as if by lot, so that parts take about the same time.
    bool has(std::uint32_t pixel) const;

    bool operator==(const Part&) const = default;
};

struct Film {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<PixelSum> pixels;
    std::vector<std::uint32_t> materials; ///< index into Scene::materials + 1 in the pixel's middle; 0 = none
    std::vector<float> coverage;          ///< share of the pixel in which there is a surface
    Incidents incidents;
    double seconds = 0; ///< spent until now

    Film() = default;
    Film(std::uint32_t filmWidth, std::uint32_t filmHeight);

    /// Root mean square over subsurface pixels and channels of the standard error, over their mean radiance. 0 when no
    /// pixel has a subsurface material; infinite while one that has samples has fewer than two.
    double noise() const;
    /// Samples of all pixels.
    std::uint64_t sampleCount() const;
};

/// The channels of a reference's EXR file, in this order: radiance R G B, coverage A, the variance of the radiance
/// (variance.R variance.G variance.B), material.ID and samples.N.
std::vector<std::string> channelNames();
/// The film's values for channelNames(), interleaved, row 0 at the top.
std::vector<float> channelValues(const Film& film);

} // namespace nacre::reference
