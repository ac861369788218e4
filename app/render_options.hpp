// What `nacre render` was asked for, parsed and checked; nothing here opens a device or a file.
#pragma once

#include "app/scene_options.hpp"
#include "renderer/offscreen.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nacre::app {

/// An image beside the picture.
struct AovOutput {
    renderer::Output output;
    std::string name;
    std::filesystem::path file; ///< ends in .exr
};

struct RenderOptions : SceneOptions {
    std::filesystem::path output = "nacre.png";
    std::filesystem::path json;
    renderer::RenderSettings settings;
    renderer::DeviceSettings device;
    float exposure = 0; ///< [EV] the picture is multiplied by 2^exposure
    std::vector<AovOutput> aovs;
};

/// Adds the options to `command`. They are in `options` once the command line has been parsed and `finish` called.
class RenderOptionParser {
public:
    explicit RenderOptionParser(CLI::App& command);

    /// The options, checked. Throws UsageError naming the option and its value.
    RenderOptions finish() const;

private:
    RenderOptions options_;
    SceneOptionParser scene_;
    std::string technique_ = "default";
    std::vector<std::string> aovs_;
    double exposure_ = 0;
    bool noScatter_ = false;
    bool noTransmit_ = false;
};

} // namespace nacre::app
