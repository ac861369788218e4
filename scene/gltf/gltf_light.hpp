// KHR_lights_punctual.
#pragma once

#include "scene/gltf/gltf_file.hpp"

#include <optional>

namespace nacre::scene {

/// The light that the node `owner` carries, if any, where `transform` puts it. Throws SceneError for values out of
/// range.
std::optional<Light> readLight(const GltfFile& file, const tinygltf::Node& node, const std::string& owner,
                               const glm::mat4& transform);

} // namespace nacre::scene
