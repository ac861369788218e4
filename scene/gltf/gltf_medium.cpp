#include "scene/gltf/gltf_medium.hpp"

#include "nacre/burley.hpp"
#include "nacre/media.hpp"

#include <algorithm>
#include <cmath>

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

double ownMeanFreePath(const GltfMedium& medium, int channel) {
    return denseMeanFreePath(medium, channel, static_cast<double>(medium.multiscatterColor[channel]));
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

bool isVolumetric(const GltfMedium& medium) {
    return medium.thickness > 0 && medium.attenuationDistance > 0 && medium.attenuationColor != glm::vec3(1);
}

double enteringShare(const GltfMedium& medium) {
    return medium.transmits ? medium.transmission : 1;
}

} // namespace

double denseMeanFreePath(const GltfMedium& medium, int channel, double color) {
    const double albedo = std::clamp(color, 0.0, 1.0);
    const double alpha = singleScatteringAlbedo(albedo, medium.anisotropy);
    const double meanFreePath = reducedMeanFreePath(1 / extinction(medium, channel), alpha, medium.anisotropy);
    return clampLength(millimetresPerMetre * meanFreePath / burleyShape(albedo, BurleyEntry::Diffuse));
}

bool isDense(const GltfMedium& medium) {
    return isVolumetric(medium) && medium.scatters && medium.multiscatterColor != glm::vec3(0) &&
           enteringShare(medium) > 0;
}

std::optional<Material> makeMaterial(const GltfMedium& medium, const std::string& name) {
    const bool volumetric = isVolumetric(medium);
    const bool scatters = medium.scatters && medium.multiscatterColor != glm::vec3(0);
    Material material;
    material.name = name;
    if (isDense(medium)) {
        material.meanFreePath = perChannel(medium, ownMeanFreePath);
        material.strength = material.translucency = enteringShare(medium);
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
