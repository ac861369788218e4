#include "app/scene_options.hpp"

#include "app/command.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace nacre::app {

namespace {

constexpr double maxCoordinate = 1e9; // as in scene files

std::optional<glm::vec3> parsePoint(const std::string& text, const std::string& option) {
    if (text.empty()) {
        return std::nullopt;
    }
    glm::vec3 point(0);
    const char* position = text.data();
    const char* const end = position + text.size();
    for (int axis = 0; axis < 3; ++axis) {
        const bool separated = axis == 0 || (position != end && *position++ == ',');
        const auto [next, error] = std::from_chars(position, end, point[axis]);
        if (!separated || error != std::errc() || !std::isfinite(point[axis]) || (axis == 2 && next != end)) {
            throw UsageError(option + " '" + text + "' is not X,Y,Z, for example 0,1.5,-2");
        }
        requireRange(point[axis], -maxCoordinate, maxCoordinate, option);
        position = next;
    }
    return point;
}

/// One value each time, so that a scene may follow it.
template <typename Value>
void addValue(CLI::App& command, const char* group, const char* name, Value& value, const std::string& description,
              const char* type) {
    command.add_option(name, value, description)->type_name(type)->group(group)->allow_extra_args(false);
}

} // namespace

void SceneOptionParser::addScene(CLI::App& command) {
    command.add_option("SCENE", options_.input, "A scene file or a model; without it the built-in gallery")
        ->type_name("");
}

void SceneOptionParser::addTime(CLI::App& command) {
    command
        .add_option("--time", time_,
                    "Show the pose that a glTF's first animation has then; default the pose of the file")
        ->type_name("SECONDS")
        ->allow_extra_args(false);
}

void SceneOptionParser::addPicture(CLI::App& command, const std::string& samplesNote) {
    const char* const picture = "Picture";
    addValue(command, picture, "--size", size_, "Pixels; default " + size_, "WxH");
    addValue(command, picture, "--samples", options_.samples,
             "Samples per axis of a pixel, 1 to " + std::to_string(maxSamples) + "; " + samplesNote + "default " +
                 std::to_string(options_.samples),
             "N");
    addValue(command, picture, "--material", options_.material,
             "Give every body this material: a preset or a material file", "NAME|FILE");
}

void SceneOptionParser::addLight(CLI::App& command) {
    const char* const light = "Light";
    command.add_flag("--front", front_, "Only the lights on the camera's side, as --light front")->group(light);
    command.add_flag("--back", back_, "Only the lights on the far side, as --light back")->group(light);
    addValue(command, light, "--light", options_.lights, "front, back, both, or a light's name; may be repeated",
             "SIDE|NAME");
}

void SceneOptionParser::addCamera(CLI::App& command) {
    const char* const camera = "Camera";
    addValue(command, camera, "--camera", options_.camera, "One of the scene's cameras; default the first",
             "NAME|NUMBER");
    addValue(command, camera, "--camera-position", cameraPosition_, "Where the camera is, scene units", "X,Y,Z");
    addValue(command, camera, "--camera-target", cameraTarget_, "What the camera looks at, scene units", "X,Y,Z");
    addValue(command, camera, "--fov", fieldOfView_, "Vertical field of view", "DEGREES");
}

SceneOptions SceneOptionParser::finish() const {
    SceneOptions options = options_;
    const PictureSize size = parseSize(size_);
    options.width = size.width;
    options.height = size.height;
    requireRange(options.samples, 1, maxSamples, "--samples");
    if (front_) {
        options.lights.emplace_back("front");
    }
    if (back_) {
        options.lights.emplace_back("back");
    }
    if (time_) {
        requireRange(*time_, 0, 1e6, "--time");
        options.time = time_;
    }
    options.cameraPosition = parsePoint(cameraPosition_, "--camera-position");
    options.cameraTarget = parsePoint(cameraTarget_, "--camera-target");
    if (fieldOfView_) {
        requireRange(*fieldOfView_, 1, 170, "--fov");
        options.fieldOfView = static_cast<float>(*fieldOfView_ * std::numbers::pi / 180);
    }
    return options;
}

} // namespace nacre::app
