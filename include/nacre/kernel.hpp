// One-dimensional kernels for separable scattering: taps at offsets in millimetres with RGB weights.
#pragma once

#include "nacre/profile.hpp"

namespace nacre {

struct KernelTap {
    Rgb weight{};      ///< [0, 1] over all taps each channel sums to 1
    double offset = 0; ///< mm, signed

    bool operator==(const KernelTap&) const = default;
};

/// Taps in order of offset, symmetric about the one in the middle, which is at 0.
using Kernel = std::vector<KernelTap>;

/// The share of the light within lineSpreadKernel's radius when none is given. It places the taps and loses no light.
inline constexpr double defaultKernelShare = 0.99;

/// The kernel to use: tap weights are masses of the line-spread over the cells between tap positions, exact for any
/// irradiance of the form f(x) + g(y), an axis-aligned shadow edge among them.
///
/// Taps are as dense as the cube root of the line-spread, (Σ_c L_c²)^⅙, which makes the mean square distance between
/// light and the tap that carries it least (Panter and Dite 1951, "Quantization distortion in pulse-count modulation");
/// each stands at its cell's centre of mass. Light beyond `radius` goes to the outermost taps, so the weights sum to 1
/// without renormalising. Errors: docs/performance.md.
///
/// tapCount: [3 … 255] odd. radius: [> 0] mm; 0 takes the profile's defaultKernelShare radius.
/// Throws std::invalid_argument naming the argument and its value.
Kernel lineSpreadKernel(const Profile& profile, int tapCount, double radius = 0);

/// The thesis's kernel (chapter 4.3, appendix A): 2·radius + 1 taps with weights from a slice R(x, 0) of the layers,
/// times the tap's width, divided by their sum. It under-weights the tails (a slice is no line-spread) and is here
/// because the thesis's figures are made with it; lineSpreadKernel costs the same and is closer.
/// Offsets are spaced quadratically over ±extent as in Jimenez's construction. A layer that is a point
/// mass (SumOfGaussiansProfile) stays at the centre.
///
/// tapRadius: [1 … 127] taps on either side. extent: [> 0] mm. Throws std::invalid_argument.
Kernel sliceKernel(std::span<const Layer> layers, int tapRadius, double extent);

/// The kernel of the separable demo (Jimenez, Zsolnai, Jarabo et al. 2012/2015, "Separable subsurface scattering"):
/// a slice through d'Eon's red skin profile without its narrowest term, stretched per channel by `falloff`, offsets in
/// the demo's unit over ±2, or ±3 with more than 20 taps. Reproduces its 11, 17 and 25 tap tables.
///
/// tapCount: [3 … 255] odd. strength [0, 1]: share of the light that scatters. falloff [0, 1].
Kernel jimenezKernel(int tapCount, const Rgb& strength = {0.48, 0.41, 0.28}, const Rgb& falloff = {1.0, 0.37, 0.3});

} // namespace nacre
