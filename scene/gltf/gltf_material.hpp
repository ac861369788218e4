// glTF materials and textures as surfaces.
#pragma once

#include "scene/gltf/gltf_material_extensions.hpp"

#include <array>
#include <map>
#include <tuple>

namespace nacre::scene {

/// Converts materials, and the textures they use, when they are first asked for.
class GltfMaterials {
public:
    GltfMaterials(const GltfFile& file, Scene& scene) : file_(file), scene_(scene) {}

    /// The surface of a material; -1 is glTF's default material.
    std::uint32_t surface(int material);
    /// The TEXCOORD sets that a surface reads as Vertex::uv and Vertex::secondUv; -1 = none.
    const std::array<int, 2>& texCoords(std::uint32_t surface) const { return texCoords_[surface]; }

private:
    std::uint32_t convert(const tinygltf::Material& source, const std::string& field);
    void readTextures(const tinygltf::Material& source, const GltfMaterialExtensions& extensions,
                      const std::string& field, Surface& surface, std::array<int, 2>& texCoords);
    void readSubsurface(const tinygltf::Material& source, const GltfMaterialExtensions& extensions,
                        const std::string& field, Surface& surface);
    /// What the textures of the transmission say of light that enters a medium that scatters it in all directions.
    void setEntry(const GltfMaterialExtensions& extensions, Surface& surface, GltfMedium& medium);
    /// The texture of lengths that belongs to that of colours, of which `medium` has the mean.
    void setScale(Surface& surface, const GltfMedium& medium, const glm::vec3& factor, std::uint32_t colors);
    /// The image of a texture; -1, with a note, where nothing that is read supplies one.
    int imageOf(const tinygltf::Texture& texture, const std::string& field);
    /// none, with a note, for a picture in a format that is known and not read.
    std::uint32_t texture(const GltfTextureUse& use, bool srgb);
    /// Of images[image].
    Texture decode(const GltfImage& image, const std::string& field, bool srgb);
    /// Of a texture of the scene, worked out once.
    const glm::vec4& mean(std::uint32_t texture);

    const GltfFile& file_;
    Scene& scene_;
    std::map<int, std::uint32_t> surfaces_;
    std::vector<std::array<int, 2>> texCoords_;
    /// By where it is, sRGB and how it is sampled.
    std::map<std::tuple<std::string, bool, Wrap, Wrap, bool>, std::uint32_t> textures_;
    std::map<std::uint32_t, glm::vec4> means_;
    struct Scale {
        float largest = 1;
        std::uint32_t texture = none;
    };
    /// By the texture of colours and all that lengths depend on.
    std::map<std::pair<std::uint32_t, std::array<float, 8>>, Scale> scales_;
};

} // namespace nacre::scene
