// What `nacre render` was asked for, parsed and checked; nothing here opens a device or a file.
#pragma once

#include "renderer/offscreen.hpp"

#include <filesystem>
#include <optional>
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

struct RenderOptions {
    std::filesystem::path input; ///< a model or scene file; empty = the gallery
    std::filesystem::path output = "nacre.png";
    std::filesystem::path json;
    renderer::RenderSettings settings;
    renderer::DeviceSettings device;
    std::string material;            ///< a preset's name or a material file; empty = the scene's own
    std::vector<std::string> lights; ///< front, back, both, or lights' names; empty = all
    std::string camera;              ///< a camera's name or number; empty = the scene's first
    std::optional<glm::vec3> cameraPosition;
    std::optional<glm::vec3> cameraTarget;
    std::optional<float> fieldOfView; ///< [rad] vertical
    float exposure = 0;               ///< [EV] the picture is multiplied by 2^exposure
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
    std::string size_ = "1280x720";
    std::string technique_ = "default";
    std::vector<std::string> aovs_;
    std::string cameraPosition_;
    std::string cameraTarget_;
    std::optional<double> fieldOfView_; ///< [degrees]
    double exposure_ = 0;
    bool front_ = false;
    bool back_ = false;
    bool noScatter_ = false;
    bool noTransmit_ = false;
};

} // namespace nacre::app
