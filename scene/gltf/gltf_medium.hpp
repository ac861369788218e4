// From glTF's physical description of a medium to a subsurface material.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// What KHR_materials_volume, _diffuse_transmission, _transmission, _volume_scatter and _scatter say of one material.
struct GltfMedium {
    double thickness = 0;           ///< [m] 0 = thin-walled
    double attenuationDistance = 0; ///< [m] 0 = not given: infinitely far
    glm::vec3 attenuationColor{1};
    bool transmits = false;      ///< one of the transmission extensions is there
    double transmission = 0;     ///< [0, 1] share of the light that enters
    double thinTransmission = 0; ///< [0, 1] share of the diffuse light that leaves on the far side of a thin wall
    std::optional<glm::vec3> transmissionColor; ///< of KHR_materials_diffuse_transmission, where it is there
    bool scatters = false;
    glm::vec3 multiscatterColor{0}; ///< albedo with all orders of scattering
    double anisotropy = 0;          ///< g of Henyey and Greenstein
};

/// [mm] Thickness given to thin walls: so thin that nothing is lost on the way through.
inline constexpr double thinWallThickness = 0.01;

/// [mm] d of a dense medium in that channel where its multiscatterColor is `color`.
double denseMeanFreePath(const GltfMedium& medium, int channel, double color);

/// Whether the medium is dense: a volume that scatters, and that light enters.
bool isDense(const GltfMedium& medium);

/// The subsurface material, or nothing for a medium that does not scatter:
///  - dense media (volume with scattering): A = multiscatterColor; single-scattering albedo α by Kulla and Conty's
///    inversion; σt = −ln(attenuationColor)/attenuationDistance; ℓ' = 1/(σt(1 − αg)); d = ℓ'/s(A) with
///    s = 1.9 − A + 3.5(A − 0.8)² (Christensen and Burley 2015, diffuse transmission); strength and translucency =
///    the share of the light that enters;
///  - volumes without scattering behind a diffuse transmission: d such that a slab of attenuationDistance transmits
///    attenuationColor;
///  - thin walls: diffuseTransmission = the transmitted share, with a spread of 0.3 mm, a leaf's thickness, chosen by
///  eye.
/// What KHR_materials_diffuse_transmission lets through has its own colour, diffuseTransmissionColor; in dense media it
/// is part of the albedo.
std::optional<Material> makeMaterial(const GltfMedium& medium, const std::string& name);

} // namespace nacre::scene
