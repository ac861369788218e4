// Scene files: JSON, docs/schemas/scene.schema.json.
#pragma once

#include "scene/scene.hpp"

#include <span>

namespace nacre::scene {

/// Reads a scene file. Paths in it are relative to it; "gallery" is the built-in gallery. Angles are in degrees.
/// Where the file has no member `lights` (or no cameras), those of its models are used, else
/// such as addMissingViewAndLights adds. An empty list has no lights.
/// `time` is that of its models, as for loadModel. Throws SceneError with one sentence that names the file, the field
/// and the value.
Scene readSceneFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                    std::optional<double> time = std::nullopt);

} // namespace nacre::scene
