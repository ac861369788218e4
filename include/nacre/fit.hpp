// Layers from anything: non-negative least squares of Gaussians.
#pragma once

#include "nacre/profile.hpp"

#include <functional>

namespace nacre {

struct LayerFit {
    std::vector<Layer> layers; ///< normalised per channel, by rising variance
    Rgb maxError{};            ///< largest error of what was compared (CDF or transform) per channel
};

/// The `layerCount` [1 … maxLayers] Gaussians shared by the channels whose CDF comes closest to the profile's in the
/// least-squares sense. Variances by pattern search, weights by non-negative least squares in every step (variable
/// projection, Golub and Pereyra 1973). Takes a tenth of a second for eight layers; layers that no channel uses are
/// left out. Throws std::invalid_argument naming the argument.
LayerFit fitLayers(const Profile& profile, int layerCount);

/// A function of the spatial frequency k [1/mm] with the value 1 at k = 0 per channel.
using SpectrumFunction = std::function<double(int channel, double k)>;

/// The same fit against a profile's two-dimensional Fourier transform: Σ w·exp(−vk²/2). `frequencies` [> 0] 1/mm, where
/// to compare. Throws std::invalid_argument naming the argument.
LayerFit fitLayersToSpectrum(const SpectrumFunction& spectrum, std::span<const double> frequencies, int layerCount);

} // namespace nacre
