// The viewer as the command starts it.
#pragma once

#include "renderer/graphics_device.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <functional>

namespace nacre::view {

struct RunSettings {
    std::filesystem::path input; ///< empty: the gallery
    /// Loads it, with what else the command line asks for.
    std::function<scene::Scene()> load;
    renderer::DeviceSettings device;
    std::filesystem::path script; ///< empty: none
};

/// Opens the window and returns the exit code when it is closed. Throws what keeps it from opening.
int runWindow(const RunSettings& settings);

} // namespace nacre::view
