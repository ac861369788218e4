// Reads models and scene files.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// In the note (Scene::notes) on a model whose unit was guessed.
inline constexpr const char* unitNote = "does not state its unit";

/// Reads a model (glTF 2.0, GLB, or any format Assimp knows) or a scene file (JSON, docs/schemas/scene.schema.json),
/// told apart by content. A model without camera or lights gets a fitted camera and a three-point light set; one with
/// lights has them dimmed or brightened where needed (`fitLights`).
/// Throws SceneError with one sentence that names the file and the field.
Scene load(const std::filesystem::path& file);

/// A model alone, exactly as the file has it (no camera or lights added).
Scene loadModel(const std::filesystem::path& file);

/// Adds what a scene needs to be looked at: a camera that sees all of it (when it has none) and key, fill and
/// back light (when it has none).
void addMissingViewAndLights(Scene& scene);

/// Scales the lights' intensities, all by the same factor, where they would leave a white surface in the middle of the
/// scene more than four times too bright or too dark: exporters write anything from 1 to 100,000 lux, the renderer
/// keeps light in half floats, and the sky and the built-in lights are of the order of 1.
void fitLights(Scene& scene);

/// Gives a surface of the scene the subsurface material of that index (or `none`), with its albedo, roughness and
/// specular where the surface has no texture for them.
void setSurfaceMaterial(Scene& scene, Surface& surface, std::uint32_t material);

/// Gives this subsurface material to the surfaces that have one, or to every surface where none has (the CLI's
/// --material); it becomes the scene's only one.
void assignMaterial(Scene& scene, const Material& material);

} // namespace nacre::scene
