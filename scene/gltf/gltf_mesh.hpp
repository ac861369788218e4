// glTF primitives as meshes.
#pragma once

#include "scene/gltf/gltf_file.hpp"
#include "scene/import_mesh.hpp"

#include <map>
#include <optional>

namespace nacre::scene {

/// A primitive's vertex attributes by name ("POSITION", "JOINTS_0" …) as floats, and its triangles.
struct GltfPrimitive {
    std::vector<float> attribute(const std::string& name, int components) const;
    bool has(const std::string& name) const { return attributes.contains(name); }

    struct Attribute {
        int components = 0;
        std::vector<float> values;
    };
    std::map<std::string, Attribute> attributes;
    std::vector<std::uint32_t> indices;
    std::size_t vertexCount = 0;
    std::string field; ///< "FILE: meshes[0].primitives[0]"
};

/// Reads a primitive, Draco-compressed or not; nothing for points and lines.
std::optional<GltfPrimitive> readPrimitive(const GltfFile& file, int mesh, std::size_t primitive);

/// Adds the morph targets with the given weights to positions and normals.
void applyMorphTargets(const GltfFile& file, int mesh, std::size_t primitive, std::span<const double> weights,
                       GltfPrimitive& target);

/// Moves positions and normals by the joints of a skin, whose nodes are at `nodeTransforms`.
void applySkin(const GltfFile& file, int skin, std::span<const glm::mat4> nodeTransforms, GltfPrimitive& target);

/// The mesh: checked, with normals, and tangents when `needsTangents`; texture coordinates from the sets
/// TEXCOORD_n that are asked for.
Mesh makeMesh(const GltfPrimitive& source, const std::array<int, 2>& texCoords, bool needsTangents,
              const TextureCoordinates& normalUv);

} // namespace nacre::scene
