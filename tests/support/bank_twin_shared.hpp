// What both halves of the bank's twin share with its shaders.
#pragma once

#include "tests/support/bank_twin.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::tests {

namespace constants {
#include "effect/bank/bank_constants.h"
} // namespace constants
static_assert(constants::bankLevels == bankLevels && constants::bankSize == bankSize);
static_assert(constants::bankBinsPerOctave == BankTable::binsPerOctave);

/// e^−q, near enough, and 0 from q = 4 on.
inline double falloff(double q) {
    const double square = std::max(0.0, 1 - q / 4) * std::max(0.0, 1 - q / 4);
    return square * square;
}

/// What a kernel's share of a pixel is multiplied by: Σ kernel · depth weight · area, which is 1 on a plane of any
/// slope.
inline double coverageOf(double area) {
    return std::min(area, 1.0);
}

inline constexpr double binomial[] = {1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0};

/// Light and area of the surface within a kernel's reach.
struct SurfaceSum {
    Rgb light{};
    double area = 0;

    /// Adds a tap, by the kernel's weight and g(Δz² / variance) of its depth from `depth` [mm]. Null and empty ones are
    /// missing. `width`: a texel's, mm; where the tap's own depths vary, it is seen from farther, as one of less area,
    /// and in the light that it has at `depth`.
    void add(const ReducedTexel* tap, double kernel, double depth, double variance, double width) {
        if (tap == nullptr || tap->coverage <= 0) {
            return;
        }
        const double distance = (tap->depth - depth) / width;
        const double closeness = 1 / (1 + 2 * tap->depthVariance / variance);
        const double weight =
            kernel * falloff(distance * distance * closeness / variance) * std::sqrt(std::sqrt(closeness));
        const double lit = weight * std::clamp<double>(1 - tap->lightSlope * distance, 0, constants::bankMostLit);
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] += lit * tap->light[channel];
        }
        area += weight * tap->area;
    }

    double coverage() const { return coverageOf(area); }

    /// Mean irradiance · coverage.
    Rgb lightOfCoverage() const {
        Rgb result = light;
        for (double& value : result) {
            value = value / std::max<double>(area, constants::bankLeastWeight) * coverage();
        }
        return result;
    }
};

// Depth step to the next pixel along one axis, mm: the mean of both sides or, where one is a step to another surface,
// the smaller. A side without a surface is null.
inline double pixelStep(const ReducedTexel* before, const ReducedTexel& pixel, const ReducedTexel* after,
                        double width) {
    const double stepBefore = before != nullptr ? pixel.depth - before->depth : 0;
    const double stepAfter = after != nullptr ? after->depth - pixel.depth : 0;
    if (before == nullptr || after == nullptr) {
        return stepBefore + stepAfter;
    }
    const double smaller = std::min(std::abs(stepBefore), std::abs(stepAfter));
    const double larger = std::max(std::abs(stepBefore), std::abs(stepAfter));
    return larger <= constants::bankContinuedStep * std::max(smaller, width) ? 0.5 * (stepBefore + stepAfter) : smaller;
}

} // namespace nacre::tests
