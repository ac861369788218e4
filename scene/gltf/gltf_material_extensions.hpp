// The extensions of glTF materials. Each is read here and nowhere else.
#pragma once

#include "scene/gltf/gltf_medium.hpp"
#include "scene/gltf/gltf_object.hpp"

#include <optional>
#include <string_view>

namespace nacre::scene {

/// KHR_materials_pbrSpecularGlossiness, which replaces the metallic and rough parameters of the core.
struct GltfSpecularGlossiness {
    glm::vec4 diffuse{1};
    glm::vec3 specular{1}; ///< [0, 1] F0
    double glossiness = 1; ///< [0, 1] 1 − roughness
    GltfTextureUse diffuseTexture;
};

/// What the extensions of one material say; the members' defaults are those of the specifications.
struct GltfMaterialExtensions {
    double ior = 1.5;            ///< KHR_materials_ior; 0 stands for infinite
    double specularFactor = 1;   ///< [0, 1] KHR_materials_specular
    double emissiveStrength = 1; ///< KHR_materials_emissive_strength
    std::optional<GltfSpecularGlossiness> specularGlossiness;
    GltfMedium medium;            ///< KHR_materials_volume and those that fill it
    double clearTransmission = 0; ///< [0, 1] KHR_materials_transmission
    GltfTextureUse thicknessTexture;
    GltfTextureUse multiscatterColorTexture;
    GltfTextureUse diffuseTransmissionTexture; ///< in its alpha
    GltfTextureUse diffuseTransmissionColorTexture;
};

/// Reads the extensions of the material `owner`; throws SceneError for values of the wrong type or out of range.
GltfMaterialExtensions readMaterialExtensions(const GltfFile& file, const tinygltf::ExtensionMap& extensions,
                                              const std::string& owner);

/// Whether a material extension is understood, or concerns only looks that this renderer does not have.
bool isMaterialExtension(std::string_view name);
/// Whether it concerns such a look: what has it is drawn without it.
bool isLookLeftOut(std::string_view name);

} // namespace nacre::scene
