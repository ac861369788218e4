// glTF primitives as meshes.
#pragma once

#include "scene/gltf/gltf_file.hpp"
#include "scene/import_mesh.hpp"

#include <map>
#include <optional>
#include <string_view>

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

inline constexpr std::string_view jointsPrefix = "JOINTS_";
inline constexpr std::string_view weightsPrefix = "WEIGHTS_";

/// "meshes[0].primitives[0]"
std::string primitiveField(int mesh, std::size_t primitive);

/// The n of a semantic like JOINTS_n; nothing where it does not begin so, or n is no plain number.
std::optional<std::size_t> setNumber(std::string_view semantic, std::string_view prefix);

/// JOINTS_n or WEIGHTS_n.
bool isSkinAttribute(std::string_view semantic);

/// Whether an attribute is read; others (a second set of colours, custom ones) are not looked at. Of sets of texture
/// coordinates there are at most ten, more than anybody has; sets of joints and weights, of which there may be any
/// number, are read for what has a skin.
bool isReadAttribute(std::string_view semantic, bool isSkinned);

/// An uncompressed attribute of the primitive that `field` names.
GltfPrimitive::Attribute readAttribute(const GltfFile& file, int accessor, const std::string& semantic,
                                       const std::string& field);

/// Reads a primitive, Draco-compressed or not; nothing for points and lines.
std::optional<GltfPrimitive> readPrimitive(const GltfFile& file, int mesh, std::size_t primitive, bool isSkinned);

/// The mesh: checked, with normals, and tangents when `needsTangents`; texture coordinates from the sets
/// TEXCOORD_n that are asked for.
Mesh makeMesh(const GltfPrimitive& source, const std::array<int, 2>& texCoords, bool needsTangents,
              const TextureCoordinates& normalUv);

} // namespace nacre::scene
