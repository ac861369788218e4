// Reads models and scene files.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// In the note (Scene::notes) on a model whose unit was guessed.
inline constexpr const char* unitNote = "does not state its unit";

/// Reads a model (glTF 2.0, GLB, or any format Assimp knows) or a scene file (JSON, docs/schemas/scene.schema.json),
/// told apart by content. A model without camera or lights gets a fitted camera and a three-point light set; one with
/// lights has them dimmed or brightened where needed (`fitLights`, default_view.hpp).
/// `time` [s] asks for the pose that a glTF's animation then has, of a scene file's models, too.
/// Throws SceneError with one sentence that names the file and the field.
Scene load(const std::filesystem::path& file, std::optional<double> time = std::nullopt);

/// Whether `load` takes the file for a scene file. Throws SceneError where it cannot be read.
bool isSceneFile(const std::filesystem::path& file);

/// A model alone, exactly as the file has it (no camera or lights added).
Scene loadModel(const std::filesystem::path& file, std::optional<double> time = std::nullopt);

} // namespace nacre::scene
