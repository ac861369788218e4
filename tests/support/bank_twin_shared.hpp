// What both halves of the bank's twin share with its shaders.
#pragma once

#include "tests/support/bank_twin.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::tests {

namespace constants {
#include "effect/shaders/bank_constants.h"
} // namespace constants
static_assert(constants::bankLevels == bankLevels && constants::bankSize == bankSize);
static_assert(constants::bankBinsPerOctave == BankTable::binsPerOctave &&
              constants::bankBinCount == BankTable::binCount);

/// e^−q, near enough, and 0 from q = 4 on.
inline double falloff(double q) {
    return std::pow(std::max(0.0, 1 - q / 4), 4);
}

/// What a kernel's share of a pixel is multiplied by: Σ kernel · depth weight · area, which is 1 on a plane of any
/// slope.
inline double massOf(double area) {
    return std::min(area, 1.0);
}

inline constexpr double binomial[] = {1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0};

/// Light and area of the surface within a kernel's reach.
struct SurfaceSum {
    Rgb light{};
    double area = 0;

    /// Adds a tap, by the kernel's weight and g(Δz² / variance) of its depth from `depth` [mm]. Null and empty ones are
    /// missing.
    void add(const RawTexel* tap, double kernel, double depth, double variance) {
        if (tap == nullptr || tap->mass <= 0) {
            return;
        }
        const double difference = tap->depth - depth;
        const double weight = kernel * falloff(difference * difference / variance);
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] += weight * tap->light[channel];
        }
        area += weight * tap->area;
    }

    double mass() const { return massOf(area); }

    /// Mean irradiance · mass.
    Rgb lightOfMass() const {
        Rgb result = light;
        for (double& value : result) {
            value = value / std::max<double>(area, constants::bankLeastWeight) * mass();
        }
        return result;
    }
};

} // namespace nacre::tests
