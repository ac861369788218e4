// Burley's normalised diffusion (Burley 2015, "Extending the Disney BRDF to a BSDF"; Christensen and Burley 2015,
// "Approximate reflectance profiles for efficient subsurface scattering", Pixar TM 15-04).
#pragma once

#include "nacre/profile.hpp"

namespace nacre {

/// R(r) = (e^{−r/d} + e^{−r/3d}) / (8πdr), one d per channel. Everything is closed form:
/// cdf = 1 − ¼e^{−r/d} − ¾e^{−r/3d}; inverse by Golubev (SIGGRAPH 2018, "Efficient screen-space subsurface
/// scattering using Burley's normalized diffusion in real time"); line-spread = (K₀(|x|/d) + K₀(|x|/3d)) / 4πd;
/// ⟨r²⟩ = 14d². R and the line-spread are infinite at 0; cdf and lineSpreadCumulative are exact there.
class BurleyProfile final : public Profile {
public:
    /// meanFreePath: d [1e-6, 1e4] mm. Throws std::invalid_argument naming the channel and its value.
    explicit BurleyProfile(const Rgb& meanFreePath);

    double radial(int channel, double r) const override;
    double cdf(int channel, double r) const override;
    double inverseCdf(int channel, double u) const override;
    double lineSpread(int channel, double x) const override;
    double lineSpreadCumulative(int channel, double x) const override;
    double rmsRadius(int channel) const override;

    const Rgb& meanFreePath() const { return meanFreePath_; }

private:
    Rgb meanFreePath_;
};

/// Most Gaussians per channel burleyLayers knows.
inline constexpr int maxBurleyTerms = 6;

/// Burley's profile as Gaussian layers: `terms` [1 … 6] Gaussians per channel (least squares on the CDF; largest CDF
/// error 0.212, 0.0845, 0.041, 0.022, 0.012, 0.0073). Channels of equal d share layers, so there are terms … 3·terms.
/// Throws std::invalid_argument on a term count or a d out of range.
std::vector<Layer> burleyLayers(const Rgb& meanFreePath, int terms = maxBurleyTerms);

} // namespace nacre
