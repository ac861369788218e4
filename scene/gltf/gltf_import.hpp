// glTF 2.0 and GLB.
#pragma once

#include "scene/scene.hpp"

#include <span>

namespace nacre::scene {

/// What a file that looks like glTF says of itself.
enum class GltfKind { None, Version1, Version2 };

/// Looks at a GLB header, or for a JSON object with an `asset`.
GltfKind gltfKind(std::span<const std::uint8_t> bytes);

/// Reads glTF 2.0 or GLB. External buffers and images are looked for beside `file`. Skins are applied in the pose the
/// nodes have, morph targets with their default weights; with a `time` [s], in those that the first animation gives
/// them then (gltf_animation.hpp). Throws SceneError with one sentence that names the file and the field.
Scene loadGltf(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
               std::optional<double> time = std::nullopt);

} // namespace nacre::scene
