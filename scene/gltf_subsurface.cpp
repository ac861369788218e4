#include "scene/gltf_subsurface.hpp"

#include "nacre/burley.hpp"
#include "nacre/media.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nacre::scene {
namespace {

constexpr double millimetresPerMetre = 1000;
/// [mm] Shortest and longest d that is made; BurleyProfile's own limits are 1e-6 and 1e4.
constexpr double shortestMeanFreePath = 1e-4;
constexpr double longestMeanFreePath = 1e3;
/// [mm] Spread of light in a thin wall.
constexpr double thinWallMeanFreePath = 0.3;

double clampLength(double d) {
    return std::isfinite(d) ? std::clamp(d, shortestMeanFreePath, longestMeanFreePath) : longestMeanFreePath;
}

/// σt [1/m]; 0 where the medium is clear.
double extinction(const GltfMedium& medium, int channel) {
    const double color = std::clamp(static_cast<double>(medium.attenuationColor[channel]), 1e-6, 1.0);
    return medium.attenuationDistance > 0 ? -std::log(color) / medium.attenuationDistance : 0;
}

double denseMeanFreePath(const GltfMedium& medium, int channel) {
    const double albedo = std::clamp(static_cast<double>(medium.multiscatterColor[channel]), 0.0, 1.0);
    const double alpha = singleScatteringAlbedo(albedo, medium.anisotropy);
    const double meanFreePath = reducedMeanFreePath(1 / extinction(medium, channel), alpha, medium.anisotropy);
    return clampLength(millimetresPerMetre * meanFreePath / burleyShape(albedo, BurleyEntry::Diffuse));
}

double absorbingMeanFreePath(const GltfMedium& medium, int channel) {
    const double color = std::clamp(static_cast<double>(medium.attenuationColor[channel]), 1e-6, 1.0);
    const double slab = BurleyProfile({1, 1, 1}).inverseCdf(channel, 1 - color); // in units of d
    return clampLength(millimetresPerMetre * medium.attenuationDistance / slab);
}

Rgb perChannel(const GltfMedium& medium, double (*length)(const GltfMedium&, int)) {
    return {length(medium, 0), length(medium, 1), length(medium, 2)};
}

std::optional<Rgb> transmissionColor(const GltfMedium& medium) {
    if (!medium.transmissionColor) {
        return std::nullopt;
    }
    return Rgb{medium.transmissionColor->x, medium.transmissionColor->y, medium.transmissionColor->z};
}

} // namespace

GltfMedium readMedium(const GltfFile& file, const tinygltf::ExtensionMap& extensions, const std::string& owner) {
    const auto extension = [&](const char* name) { return GltfObject(file, extensions, name, owner); };
    constexpr double farthest = 1e9;
    GltfMedium medium;

    const GltfObject volume = extension("KHR_materials_volume");
    medium.thickness = volume.number("thicknessFactor", 0, 0, farthest);
    medium.attenuationDistance = volume.number("attenuationDistance", 0, 0, std::numeric_limits<double>::max());
    medium.attenuationColor = volume.color("attenuationColor", glm::vec3(1));

    const GltfObject transmission = extension("KHR_materials_transmission");
    const GltfObject diffuse = extension("KHR_materials_diffuse_transmission");
    medium.transmits = transmission.exists() || diffuse.exists();
    medium.thinTransmission = diffuse.number("diffuseTransmissionFactor", 0, 0, 1);
    if (diffuse.exists()) {
        medium.transmissionColor = diffuse.color("diffuseTransmissionColorFactor", glm::vec3(1));
    }
    medium.transmission = std::max(medium.thinTransmission, transmission.number("transmissionFactor", 0, 0, 1));

    const GltfObject volumeScatter = extension("KHR_materials_volume_scatter");
    const GltfObject scatter = extension("KHR_materials_scatter");
    medium.scatters = scatter.exists() || (volumeScatter.exists() && medium.thickness > 0);
    if (scatter.exists()) {
        medium.anisotropy = scatter.number("scatterAnisotropy", 0, -1, 1);
        medium.multiscatterColor = scatter.color("multiscatterColorFactor", glm::vec3(1)) *
                                   static_cast<float>(scatter.number("scatterStrengthFactor", 0, 0, 1));
        if (medium.thickness == 0) { // thin: forward (1 + g)/2, back (1 − g)/2
            medium.thinTransmission =
                std::max(medium.transmission, medium.transmits ? 0.0 : 1.0) * 0.5 * (1 + medium.anisotropy);
        }
    } else if (medium.scatters) {
        const char* older = "multiscatterColor"; // before 2026-02
        const char* key = volumeScatter.has(older) ? older : "multiscatterColorFactor";
        medium.anisotropy = volumeScatter.number("scatterAnisotropy", 0, -1, 1);
        medium.multiscatterColor = volumeScatter.color(key, glm::vec3(0));
    }
    medium.anisotropy = std::clamp(medium.anisotropy, -0.99, 0.99); // ±1 are outside the phase function's range
    return medium;
}

std::optional<Material> makeMaterial(const GltfMedium& medium, const std::string& name) {
    const bool volumetric =
        medium.thickness > 0 && medium.attenuationDistance > 0 && medium.attenuationColor != glm::vec3(1);
    const bool scatters = medium.scatters && medium.multiscatterColor != glm::vec3(0);
    const double enters = medium.transmits ? medium.transmission : 1;
    Material material;
    material.name = name;
    if (volumetric && scatters && enters > 0) {
        material.meanFreePath = perChannel(medium, denseMeanFreePath);
        material.strength = enters;
        material.albedo = {medium.multiscatterColor.x, medium.multiscatterColor.y, medium.multiscatterColor.z};
        return material;
    }
    if (volumetric && medium.thinTransmission > 0) {
        material.meanFreePath = perChannel(medium, absorbingMeanFreePath);
        material.translucency = medium.thinTransmission;
        material.diffuseTransmissionColor = transmissionColor(medium);
        return material;
    }
    if (!volumetric && medium.thinTransmission > 0 && (scatters || !medium.scatters)) {
        material.meanFreePath = Rgb{thinWallMeanFreePath, thinWallMeanFreePath, thinWallMeanFreePath};
        material.diffuseTransmission = medium.thinTransmission;
        material.diffuseTransmissionColor = transmissionColor(medium);
        return material;
    }
    return std::nullopt;
}

} // namespace nacre::scene
