#include "nacre/radial.hpp"

#include "fault.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre {
namespace {

constexpr int ringCount = 1024;
constexpr Range supportRange{1e-6, 1e7, " mm"};

// Gauss-Legendre nodes and weights on [0, 1]; they never touch the ends, where R may be infinite.
constexpr std::array<std::array<double, 2>, 4> quadrature{{{0.06943184420297371, 0.17392742256872693},
                                                           {0.33000947820757187, 0.32607257743127307},
                                                           {0.66999052179242813, 0.32607257743127307},
                                                           {0.93056815579702629, 0.17392742256872693}}};

// Antiderivatives in ρ ≥ x > 0 of asin(x/ρ) and of 1/√(ρ² − x²).
double arcsineIntegral(double x, double r) {
    return r * std::asin(std::min(1.0, x / r)) + x * std::acosh(std::max(1.0, r / x));
}
double inverseRootIntegral(double x, double r) {
    return std::acosh(std::max(1.0, r / x));
}

RadialFunction interpolate(std::span<const double> radii, std::span<const Rgb> values) {
    if (radii.size() < 2 || radii.size() != values.size()) {
        throw std::invalid_argument("radii has " + std::to_string(radii.size()) + " and values " +
                                    std::to_string(values.size()) + " entries, must have the same number, 2 or more");
    }
    for (std::size_t i = 0; i < radii.size(); ++i) {
        requireNoFault(findFault(indexed("radii", i), radii[i], {i > 0 ? radii[i - 1] : 0, 1e7, " mm", i == 0}));
    }
    return [r = std::vector(radii.begin(), radii.end()), v = std::vector(values.begin(), values.end())](int channel,
                                                                                                        double x) {
        const auto upper = std::upper_bound(r.begin(), r.end(), x);
        if (upper == r.begin() || upper == r.end()) {
            return upper == r.begin() ? v.front()[channel] : 0.0;
        }
        const auto i = static_cast<std::size_t>(upper - r.begin());
        return std::lerp(v[i - 1][channel], v[i][channel], (x - r[i - 1]) / (r[i] - r[i - 1]));
    };
}

} // namespace

RadialProfile::RadialProfile(RadialFunction radial, double support) : radial_(std::move(radial)) {
    requireNoFault(findFault("support", support, supportRange));
    for (int i = 0; i <= ringCount; ++i) {
        const double t = double(i) / ringCount;
        radii_.push_back(support * t * t * t);
    }
    integrate();
}

RadialProfile::RadialProfile(std::span<const double> radii, std::span<const Rgb> values)
    : RadialProfile(interpolate(radii, values), radii.empty() ? 0 : radii.back()) {}

void RadialProfile::integrate() {
    cumulative_.assign(1, {});
    for (std::size_t i = 0; i + 1 < radii_.size(); ++i) {
        Rgb sum = cumulative_.back();
        const double width = radii_[i + 1] - radii_[i];
        for (int channel = 0; channel < 3; ++channel) {
            for (const auto& [node, weight] : quadrature) {
                const double r = radii_[i] + node * width;
                const double value = radial_(channel, r);
                if (!(value >= 0) || !std::isfinite(value)) {
                    throw std::invalid_argument("the radial function's " + std::string(channelNames[channel]) +
                                                " value at " + formatNumber(r) + " mm is " + formatNumber(value) +
                                                ", must be finite and not negative");
                }
                sum[channel] += weight * width * 2 * std::numbers::pi * r * value;
            }
        }
        cumulative_.push_back(sum);
    }
    total_ = cumulative_.back();
    for (int channel = 0; channel < 3; ++channel) {
        if (!(total_[channel] > 0) || !std::isfinite(total_[channel])) {
            throw std::invalid_argument("the radial function's " + std::string(channelNames[channel]) +
                                        " values integrate to " + formatNumber(total_[channel]) +
                                        ", must be more than 0 and finite");
        }
        for (Rgb& share : cumulative_) {
            share[channel] /= total_[channel];
        }
    }
}

std::size_t RadialProfile::ringAt(double r) const {
    const auto upper = std::upper_bound(radii_.begin() + 1, radii_.end() - 1, r);
    return static_cast<std::size_t>(upper - radii_.begin()) - 1;
}

double RadialProfile::radial(int channel, double r) const {
    return r < radii_.back() ? radial_(channel, r) / total_[channel] : 0;
}

double RadialProfile::cdf(int channel, double r) const {
    if (r >= radii_.back()) {
        return 1;
    }
    const std::size_t i = ringAt(r);
    const double t = (r - radii_[i]) / (radii_[i + 1] - radii_[i]);
    return std::lerp(cumulative_[i][channel], cumulative_[i + 1][channel], t);
}

double RadialProfile::inverseCdf(int channel, double u) const {
    const auto upper = std::lower_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u,
                                        [channel](const Rgb& share, double value) { return share[channel] < value; });
    const auto i = static_cast<std::size_t>(upper - cumulative_.begin());
    const double mass = cumulative_[i][channel] - cumulative_[i - 1][channel];
    const double t = mass > 0 ? std::clamp((u - cumulative_[i - 1][channel]) / mass, 0.0, 1.0) : 0;
    return std::lerp(radii_[i - 1], radii_[i], t);
}

double RadialProfile::lineSpread(int channel, double x) const {
    x = std::max(std::abs(x), 1e-9 * radii_.back()); // at most logarithmically infinite at 0
    double sum = 0;
    for (std::size_t i = ringAt(x); i + 1 < radii_.size() && x < radii_.back(); ++i) {
        const double low = std::max(radii_[i], x);
        const double density = (cumulative_[i + 1][channel] - cumulative_[i][channel]) / (radii_[i + 1] - radii_[i]);
        sum += density * (inverseRootIntegral(x, radii_[i + 1]) - inverseRootIntegral(x, low));
    }
    return sum / std::numbers::pi;
}

double RadialProfile::lineSpreadCumulative(int channel, double x) const {
    const double distance = std::abs(x);
    if (distance == 0) {
        return 0.5;
    }
    // Rings inside the distance lie wholly on one side: asin is π/2.
    double sum = 0.5 * std::numbers::pi * cdf(channel, distance);
    for (std::size_t i = ringAt(distance); i + 1 < radii_.size() && distance < radii_.back(); ++i) {
        const double low = std::max(radii_[i], distance);
        const double density = (cumulative_[i + 1][channel] - cumulative_[i][channel]) / (radii_[i + 1] - radii_[i]);
        sum += density * (arcsineIntegral(distance, radii_[i + 1]) - arcsineIntegral(distance, low));
    }
    return 0.5 + std::copysign(sum / std::numbers::pi, x);
}

double RadialProfile::rmsRadius(int channel) const {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < radii_.size(); ++i) {
        const double a = radii_[i];
        const double b = radii_[i + 1];
        sum += (cumulative_[i + 1][channel] - cumulative_[i][channel]) * (a * a + a * b + b * b) / 3;
    }
    return std::sqrt(sum);
}

} // namespace nacre
