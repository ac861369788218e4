#include "image/flip_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

/// A sensitivity a₁·e^(−b₁f²) + a₂·e^(−b₂f²) to f cycles per degree.
struct Sensitivity {
    double a1, b1, a2, b2;
};

// Andersson et al. 2020, table 1; where a₂ is 0, b₂ is 10⁻⁵ there to keep clear of a division by zero and not needed
// here.
constexpr Sensitivity sensitivities[] = {
    {1, 0.0047, 0, 0},
    {1, 0.0053, 0, 0},
    {34.1, 0.04, 13.5, 0.025},
};

// The standard deviation, in degrees, of the Gaussian that e^(−b·f²) is in the pixels' domain: e^(−π²x²/b).
double deviation(double b) {
    return std::sqrt(b / (2 * pi * pi));
}

// Andersson et al. 2020, section 4.1.3: exponent of the colour difference, and how its range is stretched. Differences
// of up to 0.4 of the largest take 0.95 of the range.
constexpr double colorExponent = 0.7;
constexpr double stretchedShare = 0.4;
constexpr double stretchedRange = 0.95;

// Section 4.2: what people see as one edge is so wide.
constexpr double featureDegrees = 0.082;

// The largest difference, between green and blue, to its exponent.
double largestColorDifference() {
    static const double largest =
        std::pow(hyab(huntAdjusted(toLab({0, 1, 0})), huntAdjusted(toLab({0, 0, 1}))), colorExponent);
    return largest;
}

// Positive taps that sum to 1 and negative ones that sum to −1.
Taps balanced(const std::vector<double>& weights) {
    double positive = 0;
    double negative = 0;
    for (const double weight : weights) {
        (weight > 0 ? positive : negative) += std::abs(weight); // 0 goes to either
    }
    Taps taps(weights.size());
    std::ranges::transform(weights, taps.begin(), [&](double weight) {
        return static_cast<float>(weight / (weight > 0 ? positive : negative));
    });
    return taps;
}

} // namespace

int contrastRadius(double pixelsPerDegree) {
    double widest = 0;
    for (const Sensitivity& sensitivity : sensitivities) {
        widest = std::max({widest, sensitivity.b1, sensitivity.b2});
    }
    return static_cast<int>(std::ceil(3 * deviation(widest) * pixelsPerDegree));
}

std::vector<FilterTerm> contrastFilter(Opponent channel, double pixelsPerDegree) {
    const Sensitivity& s = sensitivities[static_cast<std::size_t>(channel)];
    const int radius = contrastRadius(pixelsPerDegree);
    std::vector<FilterTerm> terms;
    double total = 0;
    for (const auto& [a, b] : {std::pair(s.a1, s.b1), std::pair(s.a2, s.b2)}) {
        if (a == 0) {
            continue;
        }
        double sum = 0; // of the Gaussian's taps, which gaussianTaps makes 1
        for (int tap = -radius; tap <= radius; ++tap) {
            const double degrees = tap / pixelsPerDegree;
            sum += std::exp(-pi * pi * degrees * degrees / b);
        }
        const double weight = a * std::sqrt(pi / b) * sum * sum;
        terms.push_back({weight, gaussianTaps(deviation(b) * pixelsPerDegree, radius)});
        total += weight;
    }
    for (FilterTerm& term : terms) {
        term.weight /= total;
    }
    return terms;
}

FeatureFilter featureFilter(double pixelsPerDegree) {
    const double sigma = 0.5 * featureDegrees * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    std::vector<double> edge;
    std::vector<double> point;
    for (int tap = -radius; tap <= radius; ++tap) {
        const double gaussian = std::exp(-tap * tap / (2 * sigma * sigma));
        edge.push_back(-tap * gaussian);
        point.push_back((tap * tap / (sigma * sigma) - 1) * gaussian);
    }
    return {gaussianTaps(sigma, radius), balanced(edge), balanced(point)};
}

double flipColorError(double hyabDistance) {
    const double largest = largestColorDifference();
    const double difference = std::pow(hyabDistance, colorExponent);
    const double corner = stretchedShare * largest;
    const double error = difference < corner
                             ? stretchedRange / corner * difference
                             : stretchedRange + (difference - corner) / (largest - corner) * (1 - stretchedRange);
    return std::min(error, 1.0); // rounding
}

double flipError(double colorError, double featureError) {
    return std::pow(colorError, 1 - featureError);
}

} // namespace nacre
