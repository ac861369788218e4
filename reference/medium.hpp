// The medium that belongs to a material: what a random walk goes through.
#pragma once

#include "nacre/material.hpp"
#include "nacre/media.hpp"

namespace nacre::reference {

/// What happens to light at the surface of a body.
enum class Boundary {
    /// The medium's refractive index is that of its surroundings: nothing is reflected back into the body.
    Matched,
    /// Light is reflected back into the body by Fresnel's equations, with the medium's own index, or with the one that
    /// the material's specular reflection tells of.
    Fresnel
};

/// A homogeneous medium, per channel, at one point of a surface.
struct WalkMedium {
    Rgb extinction{};      ///< [≥ 0] 1/mm, σt = σs + σa
    Rgb albedo{};          ///< [0, 1] single scattering, α = σs / σt
    double anisotropy = 0; ///< (−1, 1) Henyey and Greenstein's g
    double refractiveIndex = 1;
    Rgb gain{1, 1, 1}; ///< what the walk's light is multiplied with
};

/// How to find it. Three kinds of materials:
///
/// - whose layers are those of a preset that was fitted to a medium of Jensen et al. 2001: the medium's own
/// coefficients.
///   The walk's light is multiplied by the surface's albedo over the half space's reflectance, so that evenly lit thick
///   bodies look as in the renderer.
/// - with a mean free path d (Burley): the medium whose profile by Christensen and Burley 2015 (diffuse entry) has this
///   d at the surface's albedo A: ℓ′ = d·s(A), α from A by Kulla and Conty 2017 for a matched boundary, and by the
///   dipole's reflectance (Jensen et al. 2001) for a Fresnel one.
/// - with other layers: the same with the d whose Burley profile has the nearest CDF (least squares over 64 quantiles).
class MediumModel {
public:
    /// anisotropy: (−1, 1) how forward the walk scatters; the reduced coefficients stay what they are. Throws
    /// std::invalid_argument as makeProfile does.
    MediumModel(const Material& material, Boundary boundary, double anisotropy);

    /// The medium under a surface of this diffuse albedo.
    WalkMedium at(const Rgb& surfaceAlbedo) const;

    /// Largest difference of the CDFs where a Burley profile stands for layers, of the worst channel; otherwise 0.
    double profileError() const { return profileError_; }
    /// A channel's d [mm] or, with coefficients, its mean free path; for reports.
    const Rgb& length() const { return length_; }

private:
    Boundary boundary_;
    double anisotropy_;
    double refractiveIndex_ = 1;
    std::optional<Medium> medium_; ///< with the material's scale applied
    Rgb reflectance_{};            ///< of a half space of medium_
    Rgb length_{};
    double profileError_ = 0;
};

/// The medium of Jensen et al. 2001 that the material's layers are fitted to, or null.
const MeasuredMedium* findMedium(const Material& material);

} // namespace nacre::reference
