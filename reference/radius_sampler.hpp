// Distances in proportion to a diffusion profile.
#pragma once

#include "nacre/profile.hpp"

#include <vector>

namespace nacre::reference {

/// Beyond the radius outside which this share of the widest channel's light leaves, nothing is counted.
inline constexpr double ignoredShare = 1e-6;

/// Samples distances per channel with a density close to the profile's and known exactly. A part of the profile that
/// leaves where it entered (a layer of variance 0) is not among them; see pointShare.
class RadiusSampler {
public:
    explicit RadiusSampler(const Profile& profile);

    /// Channels that differ, and whose light does not all leave where it entered.
    const std::vector<int>& channels() const { return channels_; }
    /// Share of a channel's light that leaves where it entered.
    const Rgb& pointShare() const { return pointShare_; }
    /// [mm] distances are below it.
    double reach() const { return reach_; }

    /// A distance, mm, from an even number in (0, 1).
    double sample(int channel, double number) const;
    /// Sum over channels() of the density with which `sample` puts points on a plane at this distance, 1/mm².
    double density(double radius) const;

private:
    double edge(std::size_t ring) const;

    std::vector<int> channels_;
    Rgb pointShare_{};
    double reach_ = 0;
    double finest_ = 0; ///< [mm] rings are even below it and in geometric progression above
    double growth_ = 0;
    std::array<std::vector<double>, 3> cumulative_; ///< per ring
    std::vector<double> sum_;                       ///< per ring, over channels(): share / width
};

} // namespace nacre::reference
