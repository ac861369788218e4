// Runs an importer in a child process (core/files/isolated_process.hpp).
#pragma once

#include "core/files/isolated_process.hpp"
#include "scene/scene.hpp"

#include <functional>

namespace nacre::scene {

/// read()'s result, from a child process: runIsolated for scenes. Materials and the environment do not come across.
Scene importIsolated(const std::string& name, const ProcessLimits& limits, const std::function<Scene()>& read);

} // namespace nacre::scene
