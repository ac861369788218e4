// Profiles made of layers: sums of Gaussians (d'Eon and Luebke 2007, GPU Gems 3 ch. 14), the thesis's material model.
#pragma once

#include "nacre/profile.hpp"

#include <string>

namespace nacre {

/// R_c(r) = Σᵢ wᵢ,c · G(vᵢ, r), G(v, r) = exp(−r²/2v) / 2πv, with Σᵢ wᵢ,c = 1 per channel.
///
/// Closed forms: cdf = 1 − Σ w·exp(−r²/2v), line-spread = Σ w·N(x; v), ⟨r²⟩ = 2·Σ w·v. A layer of variance 0
/// (or under 1e-12 mm²) is a point mass at r = 0: it counts in cdf and in the line-spread's cumulative, and is left out
/// of radial and lineSpread.
class SumOfGaussiansProfile final : public Profile {
public:
    /// [1 … maxLayers layers]; weights are normalised per channel.
    /// Throws std::invalid_argument naming the field and its value (see findLayerFault).
    explicit SumOfGaussiansProfile(std::span<const Layer> layers);

    double radial(int channel, double r) const override;
    double cdf(int channel, double r) const override;
    double lineSpread(int channel, double x) const override;
    double lineSpreadCumulative(int channel, double x) const override;
    double rmsRadius(int channel) const override;

    /// The layers with weights normalised per channel.
    std::span<const Layer> layers() const { return layers_; }

private:
    std::vector<Layer> layers_;
};

/// Why these layers are no profile, e.g. "layers[2].variance is -1, must be in [0, 4e+09] mm²"; empty when they are
/// one. Refused: no layer or more than maxLayers, a weight or variance that is negative, above its range (1e6, 4e9 mm²)
/// or not finite, a channel whose weights sum to nothing.
std::string findLayerFault(std::span<const Layer> layers);

/// The layers with weights scaled so that each channel sums to 1. The layers must be free of faults.
std::vector<Layer> normalized(std::span<const Layer> layers);

/// The layers of a profile `scale` times as wide: variances · scale².
std::vector<Layer> scaled(std::span<const Layer> layers, double scale);

} // namespace nacre
