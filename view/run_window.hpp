// The viewer as the command starts it.
#pragma once

#include "nacre/material.hpp"
#include "renderer/graphics_device.hpp"

#include <filesystem>
#include <optional>

namespace nacre::view {

struct RunSettings {
    std::filesystem::path input; ///< empty: the gallery
    std::optional<Material> material;
    renderer::DeviceSettings device;
    std::filesystem::path script; ///< empty: none
};

/// Opens the window and returns the exit code when it is closed. Throws what keeps it from opening.
int runWindow(const RunSettings& settings);

} // namespace nacre::view
