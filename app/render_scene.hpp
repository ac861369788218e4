// The scene and camera that a command was asked for.
#pragma once

#include "app/scene_options.hpp"
#include "scene/scene.hpp"

namespace nacre::app {

/// "gallery", or the file's name.
std::string sceneName(const SceneOptions& options);

/// Loads the scene or builds the gallery, and applies --material and --light. Each of its notes is there once.
/// Throws UsageError, scene::SceneError or std::runtime_error with one sentence.
scene::Scene makeScene(const SceneOptions& options);

/// Says on standard error what the importer left out or assumed (Scene::notes).
void printNotes(const std::vector<std::string>& notes);

/// Throws std::runtime_error where an output would replace a file that the scene is made of, however deep that is
/// named. Empty names and "-" are not looked at.
void requireInputsKept(const SceneOptions& options, const scene::Scene& scene,
                       std::vector<std::filesystem::path> outputs);

/// Leaves the scene the lights that --light asks for, and puts in what it lacks on a side. Throws std::runtime_error
/// naming a light that the scene does not have.
void chooseLights(const SceneOptions& options, scene::Scene& scene);

/// --camera, then --camera-position, --camera-target and --fov on top of it.
/// Throws std::runtime_error when the scene has no such camera or the camera looks nowhere.
scene::Camera makeCamera(const SceneOptions& options, const scene::Scene& scene);

} // namespace nacre::app
