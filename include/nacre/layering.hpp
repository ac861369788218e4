// Layered media: slabs of different media on top of each other, as one profile (Donner and Jensen 2005, "Light
// diffusion in multi-layered translucent materials").
#pragma once

#include "nacre/fit.hpp"
#include "nacre/media.hpp"

namespace nacre {

/// A layer of a physical material; infinite thickness is allowed for the last one.
struct Slab {
    Medium medium;        ///< refractiveIndex is absolute (air is 1); thicknesses and coefficients in mm and 1/mm
    double thickness = 0; ///< [> 0] mm
};

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
    /// The same of the transmitted light. Throws std::logic_error when nothing comes through.
    LayerFit transmittanceLayers(int layerCount) const;

private:
    LayerFit fit(int layerCount, double SlabResponse::*side) const;

    std::vector<Slab> slabs_;
};

/// Human skin in three slabs: epidermis 0.25 mm, upper dermis 0.20 mm, bloody dermis below (coefficients of Donner and
/// Jensen 2005 as they are published, in 1/cm; here 1/mm).
LayeredMedium layeredSkin();

} // namespace nacre
