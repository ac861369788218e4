// What both halves of the bank's twin share with its shaders.
#pragma once

#include "nacre/bank.hpp"

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

} // namespace nacre::tests
