// Skin by what it contains: melanin, blood and water, with their published spectra.
#pragma once

#include "nacre/profile.hpp"

#include <string>

namespace nacre {

/// What a slab of skin contains, as shares of its volume. What they leave is tissue without pigment.
struct SkinContent {
    double melanin = 0;        ///< [0, 1] melanosomes: about 0.01 in fair epidermis, 0.4 in very dark; none in dermis
    double eumelanin = 1;      ///< [0, 1] brown and black share of the melanin; the rest is red and yellow pheomelanin
    double haemoglobin = 0;    ///< [0, 1] whole blood with 150 g/l of haemoglobin: about 0.002 to 0.07 in dermis
    double oxygenation = 0.75; ///< [0, 1] share of the haemoglobin that carries oxygen
    double water = 0;          ///< [0, 1] about 0.65 in dermis; hardly absorbs visible light

    bool operator==(const SkinContent&) const = default;
};

/// [nm] Where red, green and blue are sampled: the steps of 10 nm next to the dominant wavelengths of Rec.709's
/// primaries (611, 549 and 464 nm). A spectrum is read at these points, not integrated.
inline constexpr Rgb skinWavelengths{610, 550, 460};

/// "melanin is 2, must be in [0, 1]"; empty when the content is valid. Melanin and haemoglobin together fill at most
/// the whole volume.
std::string findFault(const SkinContent& content);

/// [1/mm] Absorption, each chromophore by its share of the volume:
///  - melanosomes: eumelanin 6.6·10¹⁰ λ^−3.33, pheomelanin 2.9·10¹⁴ λ^−4.75 (λ in nm; Donner and Jensen 2006, "A
///    spectral BSSRDF for shading human skin"; the first is Jacques 1998, "Skin optics summary");
///  - blood: ln 10 · ε · 150 g/l / (64,500 g/mol), with the molar extinctions ε of Prahl's table (1999, "Optical
///    absorption of hemoglobin", from Gratzer and Kollias);
///  - water: 4πk/λ, with k of Hale and Querry 1973, "Optical constants of water in the 200-nm to 200-µm region";
///  - the volume without melanin and blood: 0.0244 + 8.53·e^{−(λ − 154)/66.2} (Jacques 1998).
/// Throws std::invalid_argument naming the field.
Rgb skinAbsorption(const SkinContent& content);

/// [1/mm] Reduced scattering of skin: 4.6·(λ/500 nm)^−1.421, the mean of eight published measurements (Jacques 2013,
/// "Optical properties of biological tissues: a review", table 1).
Rgb skinReducedScattering();

} // namespace nacre
