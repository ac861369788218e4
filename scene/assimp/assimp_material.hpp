// Assimp's materials and textures as surfaces.
#pragma once

#include "scene/scene.hpp"

#include <assimp/scene.h>
#include <map>
#include <set>
#include <span>

namespace nacre::scene {

/// Converts materials, and the textures they use, when they are first asked for.
class AssimpMaterials {
public:
    AssimpMaterials(const std::filesystem::path& file, const aiScene& source, Scene& scene)
        : file_(file), source_(source), scene_(scene) {}

    /// The surface of a material of a mesh. Without a material of its own, one with vertex colours shows them as they
    /// are.
    std::uint32_t surface(unsigned material, bool hasVertexColors);
    /// What textures are for that are not read, e.g. "height, shininess".
    std::string unreadUses() const;
    /// The texture files that were read.
    const std::vector<std::string>& inputs() const { return inputs_; }

private:
    /// none, with a note, for a picture in a format that is known and not read.
    std::uint32_t texture(const aiMaterial& material, std::span<const aiTextureType> types, bool srgb);
    Texture load(const std::string& reference, const std::string& field, bool srgb);
    void addEmission(const aiMaterial& material, Surface& surface);
    void addOpacity(const aiMaterial& material, Surface& surface);
    void collectUnread(const aiMaterial& material);

    const std::filesystem::path& file_;
    const aiScene& source_;
    Scene& scene_;
    std::vector<std::string> inputs_;
    std::map<std::pair<unsigned, bool>, std::uint32_t> surfaces_;
    std::set<std::string> unreadUses_;
    /// By reference, sRGB and wraps.
    std::map<std::tuple<std::string, bool, Wrap, Wrap>, std::uint32_t> textures_;
};

} // namespace nacre::scene
