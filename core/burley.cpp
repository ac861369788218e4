#include "nacre/burley.hpp"

#include "bessel.hpp"
#include "fault.hpp"
#include "nacre/gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nacre {
namespace {

struct Term {
    double weight;
    double variance; // in units of d²
};

// Non-negative least squares of the CDF over K Gaussians, fitted by us; the errors in the header come from these.
constexpr Term burleyTerms[maxBurleyTerms][maxBurleyTerms] = {
    {{1, 2.893}},
    {{0.5362, 0.4411}, {0.4638, 11.355}},
    {{0.2801, 0.1033}, {0.4343, 2.1324}, {0.2856, 18.926}},
    {{0.1526, 0.0295}, {0.2994, 0.5862}, {0.3573, 4.5373}, {0.1907, 25.653}},
    {{0.0865, 0.0094}, {0.1855, 0.1856}, {0.2928, 1.3329}, {0.2985, 7.142}, {0.1367, 31.234}},
    {{0.0509, 0.0033}, {0.1124, 0.0640}, {0.2051, 0.4527}, {0.2713, 2.228}, {0.2554, 9.57}, {0.1048, 35.658}},
};

void check(const Rgb& meanFreePath) {
    requireNoFault(findFault("meanFreePath", meanFreePath, meanFreePathRange));
}

} // namespace

BurleyProfile::BurleyProfile(const Rgb& meanFreePath) : meanFreePath_(meanFreePath) {
    check(meanFreePath);
}

double BurleyProfile::radial(int channel, double r) const {
    const double d = meanFreePath_[channel];
    if (r <= 0) {
        return std::numeric_limits<double>::infinity();
    }
    return (std::exp(-r / d) + std::exp(-r / (3 * d))) / (8 * std::numbers::pi * d * r);
}

double BurleyProfile::cdf(int channel, double r) const {
    const double d = meanFreePath_[channel];
    return -0.25 * std::expm1(-r / d) - 0.75 * std::expm1(-r / (3 * d));
}

double BurleyProfile::inverseCdf(int channel, double u) const {
    const double d = meanFreePath_[channel];
    const double beyond = 1 - u;
    const double g = 1 + 4 * beyond * (2 * beyond + std::sqrt(1 + 4 * beyond * beyond));
    const double root = std::cbrt(g);
    // The closed form can fall a rounding error below 0 at u = 0.
    return std::max(0.0, 3 * d * std::log((1 + 1 / root + root) / (4 * beyond)));
}

double BurleyProfile::lineSpread(int channel, double x) const {
    const double d = meanFreePath_[channel];
    const double distance = std::abs(x) / d;
    if (distance == 0) {
        return std::numeric_limits<double>::infinity();
    }
    return (besselK0(distance) + besselK0(distance / 3)) / (4 * std::numbers::pi * d);
}

double BurleyProfile::lineSpreadCumulative(int channel, double x) const {
    const double distance = std::abs(x) / meanFreePath_[channel];
    const double oneSide = (besselK0Integral(distance) + 3 * besselK0Integral(distance / 3)) / (4 * std::numbers::pi);
    return 0.5 + std::copysign(oneSide, x);
}

double BurleyProfile::rmsRadius(int channel) const {
    return std::sqrt(14.0) * meanFreePath_[channel];
}

std::vector<Layer> burleyLayers(const Rgb& meanFreePath, int terms) {
    check(meanFreePath);
    requireNoFault(findFault("terms", terms, {1, maxBurleyTerms}));
    std::vector<Layer> layers;
    for (int channel = 0; channel < 3; ++channel) {
        const double d = meanFreePath[channel];
        const auto same = std::find(meanFreePath.begin(), meanFreePath.begin() + channel, d);
        const std::size_t first = static_cast<std::size_t>(same - meanFreePath.begin());
        for (int i = 0; i < terms; ++i) {
            const Term& term = burleyTerms[terms - 1][i];
            const double variance = term.variance * d * d;
            if (first == static_cast<std::size_t>(channel)) {
                layers.push_back({{}, variance});
                layers.back().weight[channel] = term.weight;
                continue;
            }
            const auto shared = std::find_if(layers.begin(), layers.end(),
                                             [&](const Layer& layer) { return layer.variance == variance; });
            shared->weight[channel] = term.weight;
        }
    }
    return normalized(layers); // the table's four digits sum to 0.9999
}

} // namespace nacre
