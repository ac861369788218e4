// Extremes that a value which is not a number cannot hide from: std::max and std::min pass it over.
#pragma once

#include <cmath>

namespace nacre::tests {

/// The larger of the two; not a number once a value was.
template <typename T> T larger(T largest, T value) {
    return std::isnan(largest) || value <= largest ? largest : value;
}

/// The smaller of the two; not a number once a value was.
template <typename T> T smaller(T smallest, T value) {
    return std::isnan(smallest) || value >= smallest ? smallest : value;
}

} // namespace nacre::tests
