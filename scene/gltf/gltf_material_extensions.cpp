#include "scene/gltf/gltf_material_extensions.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace nacre::scene {
namespace {

void readSpecularGlossiness(const GltfObject& extension, GltfMaterialExtensions& result) {
    const auto diffuse = extension.numbers("diffuseFactor", {1, 1, 1, 1}, 0, 1);
    GltfSpecularGlossiness& target = result.specularGlossiness.emplace();
    target.diffuse = glm::vec4(diffuse[0], diffuse[1], diffuse[2], diffuse[3]);
    target.specular = extension.color("specularFactor", glm::vec3(1));
    target.glossiness = extension.number("glossinessFactor", 1, 0, 1);
    target.diffuseTexture = extension.texture("diffuseTexture");
}

void readIor(const GltfObject& extension, GltfMaterialExtensions& result) {
    result.ior = extension.number("ior", result.ior, 0, 100);
}

void readSpecular(const GltfObject& extension, GltfMaterialExtensions& result) {
    result.specularFactor = extension.number("specularFactor", result.specularFactor, 0, 1);
}

void readEmissiveStrength(const GltfObject& extension, GltfMaterialExtensions& result) {
    result.emissiveStrength = extension.number("emissiveStrength", result.emissiveStrength, 0, 1e9);
}

void readVolume(const GltfObject& extension, GltfMaterialExtensions& result) {
    GltfMedium& medium = result.medium;
    medium.thickness = extension.number("thicknessFactor", 0, 0, 1e9);
    medium.attenuationDistance = extension.number("attenuationDistance", 0, 0, std::numeric_limits<double>::max());
    medium.attenuationColor = extension.color("attenuationColor", glm::vec3(1));
    result.thicknessTexture = extension.texture("thicknessTexture");
}

void readDiffuseTransmission(const GltfObject& extension, GltfMaterialExtensions& result) {
    GltfMedium& medium = result.medium;
    medium.transmits = true;
    medium.thinTransmission = extension.number("diffuseTransmissionFactor", 0, 0, 1);
    medium.transmission = std::max(medium.transmission, medium.thinTransmission);
    medium.transmissionColor = extension.color("diffuseTransmissionColorFactor", glm::vec3(1));
    result.diffuseTransmissionTexture = extension.texture("diffuseTransmissionTexture");
    result.diffuseTransmissionColorTexture = extension.texture("diffuseTransmissionColorTexture");
}

void readTransmission(const GltfObject& extension, GltfMaterialExtensions& result) {
    GltfMedium& medium = result.medium;
    medium.transmits = true;
    result.clearTransmission = extension.number("transmissionFactor", 0, 0, 1);
    medium.transmission = std::max(medium.transmission, result.clearTransmission);
}

/// Comes after KHR_materials_volume: only volumes scatter.
void readVolumeScatter(const GltfObject& extension, GltfMaterialExtensions& result) {
    GltfMedium& medium = result.medium;
    result.multiscatterColorTexture = extension.texture("multiscatterColorTexture");
    if (medium.thickness == 0) {
        return;
    }
    const char* older = "multiscatterColor"; // before 2026-02
    medium.scatters = true;
    medium.anisotropy = extension.number("scatterAnisotropy", 0, -1, 1);
    medium.multiscatterColor = extension.color(extension.has(older) ? older : "multiscatterColorFactor", glm::vec3(0));
}

/// Comes after the volume and the transmissions; it stands in for KHR_materials_volume_scatter where both are there.
void readScatter(const GltfObject& extension, GltfMaterialExtensions& result) {
    GltfMedium& medium = result.medium;
    result.multiscatterColorTexture = extension.texture("multiscatterColorTexture");
    medium.scatters = true;
    medium.anisotropy = extension.number("scatterAnisotropy", 0, -1, 1);
    medium.multiscatterColor = extension.color("multiscatterColorFactor", glm::vec3(1)) *
                               static_cast<float>(extension.number("scatterStrengthFactor", 0, 0, 1));
    if (medium.thickness == 0) { // thin: forward (1 + g)/2, back (1 − g)/2
        medium.thinTransmission =
            std::max(medium.transmission, medium.transmits ? 0.0 : 1.0) * 0.5 * (1 + medium.anisotropy);
    }
}

/// A look that this renderer does not have.
void skip(const GltfObject&, GltfMaterialExtensions&) {}

struct MaterialExtension {
    const char* name;
    void (*read)(const GltfObject&, GltfMaterialExtensions&);
};

/// In the order in which they are read: a later one builds on those before it.
constexpr std::array materialExtensions{
    MaterialExtension{"KHR_materials_pbrSpecularGlossiness", readSpecularGlossiness},
    MaterialExtension{"KHR_materials_ior", readIor},
    MaterialExtension{"KHR_materials_specular", readSpecular},
    MaterialExtension{"KHR_materials_emissive_strength", readEmissiveStrength},
    MaterialExtension{"KHR_materials_volume", readVolume},
    MaterialExtension{"KHR_materials_diffuse_transmission", readDiffuseTransmission},
    MaterialExtension{"KHR_materials_transmission", readTransmission},
    MaterialExtension{"KHR_materials_volume_scatter", readVolumeScatter},
    MaterialExtension{"KHR_materials_scatter", readScatter},
    MaterialExtension{"KHR_materials_anisotropy", skip},
    MaterialExtension{"KHR_materials_clearcoat", skip},
    MaterialExtension{"KHR_materials_dispersion", skip},
    MaterialExtension{"KHR_materials_iridescence", skip},
    MaterialExtension{"KHR_materials_sheen", skip},
    MaterialExtension{"KHR_materials_unlit", skip},
    MaterialExtension{"KHR_materials_variants", skip}};

} // namespace

GltfMaterialExtensions readMaterialExtensions(const GltfFile& file, const tinygltf::ExtensionMap& extensions,
                                              const std::string& owner) {
    GltfMaterialExtensions result;
    for (const auto& [name, read] : materialExtensions) {
        if (const GltfObject extension(file, extensions, name, owner); extension.exists()) {
            read(extension, result);
        }
    }
    // ±1 are outside the phase function's range.
    result.medium.anisotropy = std::clamp(result.medium.anisotropy, -0.99, 0.99);
    return result;
}

bool isLookLeftOut(std::string_view name) {
    return std::ranges::any_of(materialExtensions, [name](const MaterialExtension& extension) {
        return name == extension.name && extension.read == skip;
    });
}

bool isMaterialExtension(std::string_view name) {
    return std::ranges::any_of(materialExtensions, [name](const auto& extension) { return name == extension.name; });
}

} // namespace nacre::scene
