// Radial diffusion profiles: how far light entering at one point leaves the surface at another.
// Lengths in millimetres. Every profile is normalised per channel: ∫ R(r) 2πr dr = 1; how much light comes back in
// total is the albedo, never the profile.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace nacre {

/// One value per colour channel: red, green, blue (linear Rec.709).
using Rgb = std::array<double, 3>;

/// One layer of a material (thesis, chapter 4.2): RGB weight and a variance. Layer i contributes
/// weight_c · G(variance, r) with G(v, r) = exp(−r²/2v) / 2πv (d'Eon and Luebke 2007, GPU Gems 3 ch. 14).
struct Layer {
    Rgb weight{};        ///< [≥ 0] share of each channel; normalised per channel when a profile is made of the layers
    double variance = 0; ///< [≥ 0] mm²; 0 is light that leaves where it entered

    bool operator==(const Layer&) const = default;
};

/// Most layers a material may have.
inline constexpr std::size_t maxLayers = 32;

/// A radially symmetric diffusion profile, normalised per channel. `channel` is 0, 1 or 2.
class Profile {
public:
    virtual ~Profile() = default;

    /// R(r), r [≥ 0] mm, in 1/mm².
    virtual double radial(int channel, double r) const = 0;
    /// Share of the light that leaves within r [≥ 0] mm: ∫₀ʳ R(ρ) 2πρ dρ.
    virtual double cdf(int channel, double r) const = 0;
    /// The radius within which the share u [0, 1) leaves; inverse of cdf, mm.
    virtual double inverseCdf(int channel, double u) const;
    /// Line-spread L(x) = ∫ R(√(x² + y²)) dy in 1/mm: the response to an infinitely thin bright line.
    virtual double lineSpread(int channel, double x) const = 0;
    /// ∫₋∞ˣ L: the response to a step edge, exact where lineSpread is singular. Cell masses are its differences.
    virtual double lineSpreadCumulative(int channel, double x) const = 0;
    /// Share of the light that crosses a slab of thickness d [≥ 0] mm lit evenly on its far side.
    /// For every normalised radial profile this is 1 − cdf(d).
    double slabTransmittance(int channel, double d) const { return 1.0 - cdf(channel, d); }
    /// √⟨r²⟩ in mm (of the two-dimensional distribution).
    virtual double rmsRadius(int channel) const = 0;
    /// Largest inverseCdf(share) of the three channels, mm.
    double quantileRadius(double share) const;
};

} // namespace nacre
