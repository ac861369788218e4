// Physical media: scattering and absorption coefficients, what they reflect, and the profiles they make.
#pragma once

#include "nacre/radial.hpp"

#include <string>

namespace nacre {

/// A homogeneous scattering medium, coefficients per channel.
struct Medium {
    std::string name;
    Rgb reducedScattering{};      ///< [1e-4, 1e6] 1/mm, σs′ = (1 − g)·σs
    Rgb absorption{};             ///< [0, 1e6] 1/mm, σa
    double refractiveIndex = 1.3; ///< [1, 3] relative to what lies outside
    /// [−0.99, 0.99] g of Henyey and Greenstein. Diffusion needs σs′ alone; a random walk scatters with σs = σs′/(1 −
    /// g).
    Rgb anisotropy{};

    bool operator==(const Medium&) const = default;
};

/// A medium with the diffuse reflectance published beside its coefficients.
struct MeasuredMedium {
    Medium medium;
    Rgb diffuseReflectance{};
};

/// The twelve media of Jensen, Marschner, Levoy and Hanrahan 2001, "A practical model for subsurface light transport",
/// figure 5: Apple, Chicken1, Chicken2, Cream, Ketchup, Marble, Potato, Skim milk, Skin1, Skin2, Spectralon, Whole
/// milk.
std::span<const MeasuredMedium> jensenMedia();

/// "absorption[1] is -1, must be in …"; empty when the medium is valid.
std::string findFault(const Medium& medium);

/// Share of diffusely arriving light that a half space returns, by the dipole (Jensen et al. 2001; Jensen and Buhler
/// 2002, equation 4). Throws std::invalid_argument naming the field.
Rgb diffuseReflectance(const Medium& medium);

/// The dipole's profile (Jensen et al. 2001, equation 4) up to the radius outside which a millionth of the light
/// leaves, or to 1000 mean free paths in a medium that absorbs nothing. Throws std::invalid_argument naming the field.
RadialProfile dipoleProfile(const Medium& medium);

/// Share of the dipole's light within r [≥ 0] mm, closed form: the integral of z(1 + σD)e^{−σD}/D³ is that of
/// −z·e^{−σD}/D.
double dipoleCdf(const Medium& medium, int channel, double r);

/// Diffuse internal reflection: (1 + F)/(1 − F), F the average Fresnel reflectance (Egan and Hilgeman 1973, as in
/// Jensen et al. 2001 and, below 1, Donner and Jensen 2005). 1 at an index of 1 to within the fit.
double boundaryFactor(double refractiveIndex);

// ---- Albedo, mean free path and anisotropy g [−1, 1] (Henyey and Greenstein's), by similarity (van de Hulst 1980):
// σs′ = (1 − g)σs, so α′ = α(1 − g)/(1 − αg) and ℓ′ = ℓ/(1 − αg).

/// α′ of a single-scattering albedo α [0, 1].
double reducedAlbedo(double singleScatteringAlbedo, double anisotropy);
/// ℓ′ of a mean free path ℓ = 1/σt, in its unit.
double reducedMeanFreePath(double meanFreePath, double singleScatteringAlbedo, double anisotropy);
/// What an index-matched half space returns of diffusely arriving light (van de Hulst 1980, as in the OpenPBR
/// specification): C = (1 − q)(1 − 0.139q)/(1 + 1.17q), q = √(1 − α′).
double diffuseAlbedo(double singleScatteringAlbedo, double anisotropy);
/// The inverse: α that returns C [0, 1] (Kulla and Conty 2017, "Revisiting physically based shading at Imageworks").
double singleScatteringAlbedo(double diffuseAlbedo, double anisotropy);
/// Another inverse at g = 0 (Chiang, Kutz and Burley 2016, "Practical and controllable subsurface scattering for
/// production path tracing", equation 1), for media with the mean free path of burleyShape's Diffuse fit.
double chiangSingleScatteringAlbedo(double diffuseAlbedo);

/// How the light enters, and which length s scales (Christensen and Burley 2015, equations 5, 6 and 8).
enum class BurleyEntry {
    Searchlight,                   ///< perpendicular, ℓ = 1/σt′: s = 1.85 − A + 7|A − 0.8|³
    Diffuse,                       ///< from everywhere, ℓ = 1/σt′: s = 1.9 − A + 3.5(A − 0.8)²
    SearchlightDiffuseMeanFreePath ///< perpendicular, ℓd = 1/√(3σaσt′): s = 3.5 + 100(A − 0.33)⁴; useless towards A = 1
};

/// s(A): Burley's d is the length divided by it. A: diffuse albedo [0, 1].
double burleyShape(double diffuseAlbedo, BurleyEntry entry);

/// Material::meanFreePath (Burley's d, mm) of a medium told by its diffuse albedo [0, 1], mean free path 1/σt [> 0] mm
/// and anisotropy, as glTF, OpenPBR and MaterialX tell it: d = ℓ′/s(A) with diffuse entry. The Gaussian or Burley
/// profile of media above A = 0.9 is up to 20 % off per radius. Of white media with long mean free paths it may exceed
/// Material's range.
Rgb burleyMeanFreePath(const Rgb& diffuseAlbedo, const Rgb& meanFreePath, double anisotropy = 0);

} // namespace nacre
