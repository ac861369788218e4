// Layered media: slabs of different media on top of each other, as one profile (Donner and Jensen 2005, "Light
// diffusion in multi-layered translucent materials").
#pragma once

#include "nacre/fit.hpp"
#include "nacre/material.hpp"
#include "nacre/slab_stack.hpp"

namespace nacre {

/// What a stack does to light at the spatial frequency k: the two-dimensional Fourier transforms of its profiles.
struct SlabResponse {
    double reflectanceTop = 0;    ///< lit from above
    double reflectanceBottom = 0; ///< lit from below
    double transmittanceDown = 0;
    double transmittanceUp = 0;
};

/// A slab by the multipole in closed form: the diffusion equation's solution for a source inside, with extrapolated
/// boundaries, is a ratio of hyperbolic functions of q = √(k² + 3σaσt′). Donner and Jensen's source has all light, one
/// mean free path ℓ deep. Ours has 1 − e^{−t/ℓ} of it, at the mean depth at which a beam meets something inside the
/// slab, ℓ − t/(e^{t/ℓ} − 1); the rest passes as it came but for what is reflected towards a thinner neighbour. Thick
/// slabs are theirs; index-matched ones of any thickness reflect what random walks do to 0.012, without absorption, and
/// what the stack of their halves does to 1 %. above, below: refractive indices of the neighbours.
SlabResponse slabResponse(const Slab& slab, int channel, double k, double above = 1, double below = 1);

/// Two stacks on top of each other: T₁₂ = T₁T₂/(1 − R₁R₂), R₁₂ = R₁ + T₁R₂T₁/(1 − R₁R₂), with each side's own R.
SlabResponse stacked(const SlabResponse& top, const SlabResponse& bottom);

/// A stack of slabs, top first, in air.
class LayeredMedium {
public:
    /// [1 … 32 slabs] Throws std::invalid_argument naming the field and its value, e.g. "slabs[1].thickness is 0, …".
    explicit LayeredMedium(std::vector<Slab> slabs);

    SlabResponse response(int channel, double k) const;

    /// Share of diffuse light that comes back, and that comes through. They sum to at most 1.
    Rgb diffuseReflectance() const;
    Rgb diffuseTransmittance() const;
    /// √⟨r²⟩ of the reflected light, mm, from the transform's curvature at k = 0. Infinite where the last slab is
    /// and absorbs nothing.
    Rgb rmsRadius() const;

    /// The reflected light's profile as Gaussian layers, as Donner and Jensen's profiles were used for skin. maxError
    /// is that of the transform.
    LayerFit reflectanceLayers(int layerCount) const;
    /// Share of the reflected light that leaves within r [≥ 0] mm: r·∫ R̃(k) J₁(kr) dk / R̃(0), to about 1e-4.
    double reflectanceCdf(int channel, double r) const;
    /// Largest difference of the layers' CDF from reflectanceCdf, per channel, over the radii within which 0.5 to
    /// 99.9 % of the layers' light leaves.
    Rgb cdfError(std::span<const Layer> layers) const;
    /// The same of the transmitted light. Throws std::logic_error when nothing comes through.
    LayerFit transmittanceLayers(int layerCount) const;

private:
    LayerFit fit(int layerCount, double SlabResponse::*side) const;

    std::vector<Slab> slabs_;
};

/// Layers that a material is given for its slabs.
inline constexpr int slabLayerCount = 8;

/// Describes a material by a stack in air: keeps the slabs, and sets `layers` to the reflectance's slabLayerCount
/// Gaussians, `albedo` to the share of diffuse light that comes back, and `specular` to the first slab's
/// F0 = ((n − 1)/(n + 1))², at most 1. Some tenths of a second. Throws std::invalid_argument naming the field.
void describeBySlabs(Material& material, std::vector<Slab> slabs);

/// The layers that describeBySlabs sets.
std::vector<Layer> layersOf(std::span<const Slab> slabs);

/// Human skin in three slabs: epidermis 0.25 mm, upper dermis 0.20 mm, bloody dermis below (coefficients of Donner and
/// Jensen 2005 as they are published, in 1/cm; here 1/mm).
LayeredMedium layeredSkin();

} // namespace nacre
