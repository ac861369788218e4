// KHR_draco_mesh_compression.
#pragma once

#include "scene/gltf/gltf_mesh.hpp"

#include <nlohmann/json_fwd.hpp>

namespace nacre::scene {

/// Takes the indices from compressed primitives of the document: Draco brings its own, and tinygltf would refuse the
/// accessor that only counts them.
void dropDracoIndices(nlohmann::json& document);

bool isDraco(const tinygltf::Primitive& primitive);

/// Decodes a compressed primitive; throws SceneError when the data are damaged.
GltfPrimitive decodeDraco(const GltfFile& file, const tinygltf::Primitive& source, const std::string& field,
                          bool isSkinned);

} // namespace nacre::scene
