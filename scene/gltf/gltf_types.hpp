// The types of a glTF document's members. tinygltf takes the default where an optional member has another type.
#pragma once

#include "scene/gltf/gltf_file.hpp"

#include <nlohmann/json.hpp>

namespace nacre::scene {

/// Largest whole number that is accepted as an index, a count or an offset: tinygltf keeps them in an int.
inline constexpr std::uint32_t maxGltfIndex = 2147483647;

/// Whether a value is a whole number from 0 to maxGltfIndex.
bool isGltfIndex(const nlohmann::json& value);

/// Throws SceneError, naming the field and its value, for a member that is read here and has another type than glTF
/// gives it. null stands for a member that is not there.
void checkGltfTypes(const GltfFile& file, const nlohmann::json& document);

} // namespace nacre::scene
