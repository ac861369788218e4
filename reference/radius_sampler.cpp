#include "reference/radius_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::reference {
namespace {

constexpr std::size_t ringCount = 512;
/// Of the narrowest channel's median distance: below it rings are even.
constexpr double finestShare = 0.05;

} // namespace

RadiusSampler::RadiusSampler(const Profile& profile) {
    reach_ = profile.quantileRadius(1 - ignoredShare);
    finest_ = reach_;
    for (int channel = 0; channel < 3; ++channel) {
        pointShare_[channel] = profile.cdf(channel, 0);
        const double median = profile.inverseCdf(channel, pointShare_[channel] + 0.5 * (1 - pointShare_[channel]));
        if (median > 0) {
            finest_ = std::min(finest_, finestShare * median);
        }
    }
    if (!(reach_ > 0)) {
        return; // everything leaves where it entered
    }
    growth_ = std::log1p(reach_ / finest_) / ringCount;
    sum_.resize(ringCount);
    for (int channel = 0; channel < 3; ++channel) {
        const double total = profile.cdf(channel, reach_) - pointShare_[channel];
        if (!(total > 0)) {
            continue;
        }
        std::vector<double>& cumulative = cumulative_[channel];
        for (std::size_t ring = 0; ring < ringCount; ++ring) {
            cumulative.push_back((profile.cdf(channel, edge(ring + 1)) - pointShare_[channel]) / total);
        }
        cumulative.back() = 1;
        if (std::ranges::any_of(channels_, [&](int other) { return cumulative_[other] == cumulative; })) {
            continue;
        }
        channels_.push_back(channel);
        for (std::size_t ring = 0; ring < ringCount; ++ring) {
            const double share = cumulative[ring] - (ring > 0 ? cumulative[ring - 1] : 0);
            sum_[ring] += share / (edge(ring + 1) - edge(ring));
        }
    }
}

double RadiusSampler::edge(std::size_t ring) const {
    return ring == ringCount ? reach_ : finest_ * std::expm1(growth_ * static_cast<double>(ring));
}

double RadiusSampler::sample(int channel, double number) const {
    const std::vector<double>& cumulative = cumulative_[channel];
    const auto found = std::ranges::upper_bound(cumulative, number);
    const std::size_t ring = std::min(static_cast<std::size_t>(found - cumulative.begin()), ringCount - 1);
    const double before = ring > 0 ? cumulative[ring - 1] : 0;
    const double share = cumulative[ring] - before;
    const double within = share > 0 ? std::clamp((number - before) / share, 0.0, 1.0) : 0.5;
    return edge(ring) + within * (edge(ring + 1) - edge(ring));
}

double RadiusSampler::density(double radius) const {
    if (radius >= reach_) {
        return 0;
    }
    const auto ring = static_cast<std::size_t>(std::log1p(radius / finest_) / growth_);
    return sum_[std::min(ring, ringCount - 1)] / (2 * std::numbers::pi * std::max(radius, 1e-12));
}

} // namespace nacre::reference
