// Which scene, light and camera a command was asked for, and how large a picture: what `nacre render` and
// `nacre reference` share. Parsed and checked; nothing here opens a file.
#pragma once

#include "scene/scene.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nacre::app {

struct SceneOptions {
    std::filesystem::path input; ///< a model or scene file; empty = the gallery
    std::uint32_t width = 1280;  ///< px
    std::uint32_t height = 720;
    std::uint32_t samples = 1;       ///< [1 … maxSamples] per axis of a pixel
    std::string material;            ///< a preset's name or a material file; empty = the scene's own
    std::vector<std::string> lights; ///< front, back, both, or lights' names; empty = all
    std::string camera;              ///< a camera's name or number; empty = the scene's first
    std::optional<glm::vec3> cameraPosition;
    std::optional<glm::vec3> cameraTarget;
    std::optional<double> time;       ///< [s] of a glTF animation; absent: the pose of the file
    std::optional<float> fieldOfView; ///< [rad] vertical
};

/// Most samples per axis of a pixel.
inline constexpr std::uint32_t maxSamples = 4;

/// Adds the options to a command, a group at a time. They are in `finish` once the command line has been parsed.
class SceneOptionParser {
public:
    /// The positional argument.
    void addScene(CLI::App& command);
    /// --time.
    void addTime(CLI::App& command);
    /// --size, --samples and --material, to the group "Picture". samplesNote ends the description of --samples.
    void addPicture(CLI::App& command, const std::string& samplesNote);
    /// --front, --back and --light.
    void addLight(CLI::App& command);
    /// --camera, --camera-position, --camera-target and --fov.
    void addCamera(CLI::App& command);

    /// The options, checked. Throws UsageError naming the option and its value.
    SceneOptions finish() const;

private:
    SceneOptions options_;
    std::string size_ = "1280x720";
    std::string cameraPosition_;
    std::string cameraTarget_;
    std::optional<double> time_;
    std::optional<double> fieldOfView_; ///< [degrees]
    bool front_ = false;
    bool back_ = false;
};

} // namespace nacre::app
