// EXT_mesh_gpu_instancing: a node that stands for many.
#pragma once

#include "scene/gltf/gltf_object.hpp"

namespace nacre::scene {

/// Where the node's mesh is placed, as transforms before the node's own: one identity where the node `owner` has no
/// such extension. Throws SceneError for attributes of differing counts or of the wrong type.
std::vector<glm::mat4> readInstances(const GltfFile& file, const tinygltf::Node& node, const std::string& owner);

} // namespace nacre::scene
