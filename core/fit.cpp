#include "nacre/fit.hpp"

#include "fault.hpp"
#include "simplex.hpp"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

constexpr int capacity = static_cast<int>(maxLayers);
using Problem = SimplexProblem<capacity>;

// Where a channel is compared. Both domains have one form: the target is close to Σ w·exp(−½·(s·√v)^±2), with the
// distance s and exponent −2 for 1 − CDF, with the frequency s and exponent +2 for the transform.
struct Samples {
    std::vector<double> position;
    std::vector<double> target;
};

struct Problems {
    std::array<Samples, 3> channels;
    bool spectrum = false;

    double basis(double logVariance, double position) const {
        const double variance = std::exp(logVariance);
        const double square = position * position;
        return std::exp(-0.5 * (spectrum ? square * variance : square / variance));
    }
};

struct Solution {
    std::vector<double> logVariances;
    std::vector<Rgb> weights;
    double error = 0; // mean square over the samples, summed over the channels
};

// The best weights for these variances.
Solution solveWeights(const Problems& problems, const std::vector<double>& logVariances) {
    const int count = static_cast<int>(logVariances.size());
    Solution solution{logVariances, std::vector<Rgb>(logVariances.size()), 0};
    Problem::Matrix gram;
    Problem::Vector rightHandSide;
    Problem::Vector row{};
    for (int channel = 0; channel < 3; ++channel) {
        const Samples& samples = problems.channels[channel];
        for (int i = 0; i < count; ++i) {
            rightHandSide[i] = 0;
            std::fill_n(gram[i].begin(), count, 0.0);
        }
        double targetSquares = 0;
        for (std::size_t s = 0; s < samples.position.size(); ++s) {
            for (int i = 0; i < count; ++i) {
                row[i] = problems.basis(logVariances[i], samples.position[s]);
                rightHandSide[i] += row[i] * samples.target[s];
                for (int j = 0; j <= i; ++j) {
                    gram[i][j] += row[i] * row[j];
                }
            }
            targetSquares += samples.target[s] * samples.target[s];
        }
        // Keeps the factorisation stable when two variances meet; far below the fit's own error.
        const double ridge = 1e-10 * static_cast<double>(samples.position.size());
        for (int i = 0; i < count; ++i) {
            gram[i][i] += ridge;
            for (int j = 0; j < i; ++j) {
                gram[j][i] = gram[i][j];
            }
        }
        Problem::Vector x{};
        std::fill_n(x.begin(), count, 1.0 / count);
        Problem(gram, rightHandSide, count).solve(x);
        double error = targetSquares;
        for (int i = 0; i < count; ++i) {
            solution.weights[i][channel] = x[i];
            error -= 2 * x[i] * rightHandSide[i];
            for (int j = 0; j < count; ++j) {
                error += x[i] * x[j] * gram[i][j];
            }
        }
        solution.error += error / static_cast<double>(samples.position.size());
    }
    return solution;
}

// Hooke and Jeeves: moves one variance at a time, halves the step when nothing helps.
Solution search(const Problems& problems, Solution best) {
    constexpr double finestStep = 2e-3; // of log variance
    for (double step = 0.5; step > finestStep;) {
        const double before = best.error;
        for (std::size_t i = 0; i < best.logVariances.size(); ++i) {
            for (const double direction : {step, -step}) {
                std::vector<double> moved = best.logVariances;
                moved[i] += direction;
                if (Solution candidate = solveWeights(problems, moved); candidate.error < best.error) {
                    best = std::move(candidate);
                    break;
                }
            }
        }
        if (best.error > 0.999 * before) {
            step *= 0.5;
        }
    }
    return best;
}

LayerFit fit(const Problems& problems, double lowVariance, double highVariance, int layerCount) {
    std::vector<double> logVariances;
    for (int i = 0; i < layerCount; ++i) {
        logVariances.push_back(std::lerp(std::log(lowVariance), std::log(highVariance), (i + 0.5) / layerCount));
    }
    const Solution best = search(problems, solveWeights(problems, logVariances));
    LayerFit result;
    for (std::size_t i = 0; i < best.weights.size(); ++i) {
        if (const Rgb& w = best.weights[i]; std::max({w[0], w[1], w[2]}) > 1e-6) {
            result.layers.push_back({w, std::exp(best.logVariances[i])});
        }
    }
    std::sort(result.layers.begin(), result.layers.end(),
              [](const Layer& a, const Layer& b) { return a.variance < b.variance; });
    for (int channel = 0; channel < 3; ++channel) {
        const Samples& samples = problems.channels[channel];
        for (std::size_t s = 0; s < samples.position.size(); ++s) {
            double value = 0;
            for (const Layer& layer : result.layers) {
                value += layer.weight[channel] * problems.basis(std::log(layer.variance), samples.position[s]);
            }
            result.maxError[channel] = std::max(result.maxError[channel], std::abs(value - samples.target[s]));
        }
    }
    return result;
}

void checkLayerCount(int layerCount) {
    requireNoFault(findFault("layerCount", layerCount, {1, double(maxLayers), ""}));
}

} // namespace

LayerFit fitLayers(const Profile& profile, int layerCount) {
    checkLayerCount(layerCount);
    constexpr int sampleCount = 160;
    Problems problems;
    double low = profile.quantileRadius(0.98);
    double high = 0;
    for (int channel = 0; channel < 3; ++channel) {
        const double reach = profile.inverseCdf(channel, 0.9995);
        low = std::min(low, profile.inverseCdf(channel, 0.05));
        high = std::max(high, profile.inverseCdf(channel, 0.98));
        for (int i = 1; i <= sampleCount; ++i) {
            const double t = double(i) / sampleCount;
            const double r = reach * t * t;
            problems.channels[channel].position.push_back(r);
            problems.channels[channel].target.push_back(1 - profile.cdf(channel, r));
        }
    }
    // A Gaussian of variance v has the radius √(2v) within which 63 % lie.
    low = std::max(low, 1e-3 * high);
    return fit(problems, 0.5 * low * low, 0.5 * high * high, layerCount);
}

LayerFit fitLayersToSpectrum(const SpectrumFunction& spectrum, std::span<const double> frequencies, int layerCount) {
    checkLayerCount(layerCount);
    if (frequencies.size() < 2) {
        throw std::invalid_argument("frequencies has " + std::to_string(frequencies.size()) +
                                    " entries, must have 2 or more");
    }
    Problems problems;
    problems.spectrum = true;
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
        requireNoFault(findFault(indexed("frequencies", i), frequencies[i], {0, 1e9, " 1/mm", false}));
        for (int channel = 0; channel < 3; ++channel) {
            problems.channels[channel].position.push_back(frequencies[i]);
            problems.channels[channel].target.push_back(spectrum(channel, frequencies[i]));
        }
    }
    const auto [lowest, highest] = std::minmax_element(frequencies.begin(), frequencies.end());
    return fit(problems, 1 / (*highest * *highest), 1 / (*lowest * *lowest), layerCount);
}

} // namespace nacre
