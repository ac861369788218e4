// Typed, range-checked reads of a JSON object that tinygltf leaves as it is, such as an extension.
#pragma once

#include "scene/gltf/gltf_file.hpp"

namespace nacre::scene {

/// A texture as a material refers to it.
struct GltfTextureUse {
    int texture = -1; ///< index into textures; -1 = none
    int texCoord = 0;
    glm::mat3 transform{1}; ///< KHR_texture_transform
    std::string field;
};

/// An object that may be missing; what is read from a missing one is the fallback. Values of the wrong type or out of
/// range are a SceneError that names the field.
class GltfObject {
public:
    GltfObject(const GltfFile& file, const tinygltf::Value& value, std::string field);
    /// The extension `name` of `owner`.
    GltfObject(const GltfFile& file, const tinygltf::ExtensionMap& extensions, const std::string& name,
               const std::string& owner);

    bool exists() const { return value_ != nullptr; }
    bool has(const char* key) const { return exists() && value_->Has(key); }
    double number(const char* key, double fallback, double low, double high) const;
    int index(const char* key) const; ///< -1 when it is missing
    bool boolean(const char* key, bool fallback) const;
    std::string text(const char* key) const;
    /// As many numbers as `fallback` has, each in [low, high].
    std::vector<double> numbers(const char* key, std::vector<double> fallback, double low, double high) const;
    glm::vec3 color(const char* key, const glm::vec3& fallback) const; ///< [0, 1]
    GltfObject object(const char* key) const;
    GltfTextureUse texture(const char* key) const;

private:
    const tinygltf::Value* find(const char* key) const;
    std::string fieldOf(const char* key) const { return field_ + "." + key; }

    const GltfFile* file_;
    const tinygltf::Value* value_ = nullptr;
    std::string field_;
};

/// Checks a number that tinygltf has read; values within rounding of the range are moved into it.
double checkRange(const GltfFile& file, double value, double low, double high, const std::string& field);

/// Three numbers that tinygltf has read, or `fallback` where there are none.
glm::vec3 vectorOf(const GltfFile& file, const std::vector<double>& values, const glm::vec3& fallback,
                   const std::string& field);

/// KHR_texture_transform of a texture reference: T·R·S as its specification writes it.
void readTextureTransform(const GltfObject& extension, GltfTextureUse& use);

} // namespace nacre::scene
