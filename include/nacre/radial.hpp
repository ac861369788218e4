// A profile from any radial function or measured table, integrated numerically.
#pragma once

#include "nacre/profile.hpp"

#include <functional>

namespace nacre {

/// R of a channel (0, 1, 2) at r [> 0] mm, finite and not negative; a factor per channel does not matter.
using RadialFunction = std::function<double(int channel, double r)>;

/// The radial density 2πrR is integrated over 1024 rings, graded towards the centre, and taken as even within each.
/// Every integral is then exact for that distribution: a ring of radius ρ spreads over a line by the arcsine law, so
/// ∫₋∞ˣ L = ½ + (1/π)·∫ 2πρR asin(min(1, x/ρ)) dρ, and rings sum in closed form. The CDF of smooth functions is right
/// to 3e-5, the response to an edge to 6e-6. R may grow like 1/r towards the centre (Burley's does).
class RadialProfile final : public Profile {
public:
    /// support: [> 0] mm, R is 0 beyond. Throws std::invalid_argument when the function returns NaN, infinity or less
    /// than 0, or is 0 everywhere.
    RadialProfile(RadialFunction radial, double support);
    /// Linear between samples; radii [2 … samples] mm, rising, from 0 or more (the first value holds below it); 0
    /// beyond the last. Throws std::invalid_argument naming the entry.
    RadialProfile(std::span<const double> radii, std::span<const Rgb> values);

    double radial(int channel, double r) const override;
    double cdf(int channel, double r) const override;
    double inverseCdf(int channel, double u) const override;
    double lineSpread(int channel, double x) const override;
    double lineSpreadCumulative(int channel, double x) const override;
    double rmsRadius(int channel) const override;

private:
    void integrate();
    std::size_t ringAt(double r) const;

    RadialFunction radial_;
    std::vector<double> radii_;   // ring i lies between radii_[i] and radii_[i + 1]
    std::vector<Rgb> cumulative_; // share within radii_[i]
    Rgb total_{};                 // of radial_ before normalisation
};

} // namespace nacre
