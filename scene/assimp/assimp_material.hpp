// Assimp's materials and textures as surfaces.
#pragma once

#include "scene/scene.hpp"

#include <assimp/scene.h>
#include <map>

namespace nacre::scene {

/// Converts materials, and the textures they use, when they are first asked for.
class AssimpMaterials {
public:
    AssimpMaterials(const std::filesystem::path& file, const aiScene& source, Scene& scene)
        : file_(file), source_(source), scene_(scene) {}

    std::uint32_t surface(unsigned material);
    /// The texture files that were read.
    const std::vector<std::string>& inputs() const { return inputs_; }

private:
    std::uint32_t texture(const aiMaterial& material, std::initializer_list<aiTextureType> types, bool srgb);
    Texture load(const std::string& reference, const std::string& field, bool srgb);
    void addOpacity(const aiMaterial& material, Surface& surface);

    const std::filesystem::path& file_;
    const aiScene& source_;
    Scene& scene_;
    std::vector<std::string> inputs_;
    std::map<unsigned, std::uint32_t> surfaces_;
    /// By reference, sRGB and wraps.
    std::map<std::tuple<std::string, bool, Wrap, Wrap>, std::uint32_t> textures_;
};

} // namespace nacre::scene
