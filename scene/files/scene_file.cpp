#include "scene/files/scene_file.hpp"

#include "image/image_file.hpp"
#include "scene/default_view.hpp"
#include "scene/files/scene_file_light.hpp"
#include "scene/files/scene_file_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nacre::scene {
namespace {

class SceneFileReader {
public:
    SceneFileReader(const std::filesystem::path& file, SceneFileObject root, std::optional<double> time)
        : path_(file), root_(std::move(root)), time_(time) {}

    Scene read() {
        root_.text("$schema");
        scene_.name = root_.text("name", path_.stem().string());
        scene_.metersPerUnit = root_.number("metersPerUnit", 1, {1e-6, 1e6});
        scene_.exposure = root_.real("exposure", 1, positive);
        root_.require("models");
        std::vector<SceneFileObject> models = root_.objects("models");
        if (models.empty()) {
            root_.refuse("models", "an array with at least one model");
        }
        SceneFileModels(path_.string(), scene_, time_).add(models);
        std::vector<Light> lights;
        for (SceneFileObject& light : root_.objects("lights")) {
            lights.push_back(readLight(light));
        }
        std::vector<Camera> cameras;
        for (SceneFileObject& camera : root_.objects("cameras")) {
            cameras.push_back(readCamera(camera));
        }
        if (root_.has("lights")) {
            scene_.lights = std::move(lights);
        } else {
            fitLights(scene_); // as where a model is loaded by itself
        }
        if (!cameras.empty()) {
            scene_.cameras = std::move(cameras);
        }
        SceneFileObject environment = root_.object("environment");
        readEnvironment(environment);
        root_.finish();
        const bool isDark = root_.has("lights") && scene_.lights.empty();
        addMissingViewAndLights(scene_);
        if (isDark) {
            scene_.lights.clear();
        }
        return std::move(scene_);
    }

private:
    static Camera readCamera(SceneFileObject& object) {
        constexpr std::array projections{"perspective", "orthographic"};
        Camera camera;
        camera.name = object.text("name");
        object.require("position");
        camera.position = object.triple("position", camera.position);
        camera.target = object.triple("target", camera.target);
        if (!(glm::distance(camera.position, camera.target) > 0)) {
            object.refuse("position", "another point than the target");
        }
        camera.up = object.triple("up", camera.up);
        checkDirection(object, "up", camera.up);
        camera.up = glm::normalize(camera.up);
        const glm::vec3 view = glm::normalize(camera.target - camera.position);
        if (glm::length(glm::cross(view, camera.up)) < 1e-5f) {
            throw SceneError(object.file() + ": " + object.fieldOf("up") + " is parallel to the view direction");
        }
        camera.projection = static_cast<ProjectionKind>(object.choice("projection", 0, projections));
        camera.verticalFieldOfView =
            object.real("verticalFieldOfView", camera.verticalFieldOfView / degree, {0.01, 170}) * degree;
        camera.orthographicHeight = object.real("orthographicHeight", camera.orthographicHeight, positive);
        camera.offCenter = object.pair("offCenter", camera.offCenter, {-10, 10});
        camera.nearPlane = object.real("nearPlane", camera.nearPlane, nonNegative);
        camera.farPlane = object.real("farPlane", camera.farPlane, nonNegative);
        if (camera.farPlane > 0 && camera.farPlane <= camera.nearPlane) {
            object.refuse("farPlane", "beyond nearPlane");
        }
        object.finish();
        return camera;
    }

    void readEnvironment(SceneFileObject& object) {
        Environment& environment = scene_.environment;
        environment.intensity = object.real("intensity", environment.intensity, nonNegative);
        environment.rotation = object.real("rotation", 0) * degree;
        environment.zenith = object.triple("zenith", environment.zenith, nonNegative);
        environment.horizon = object.triple("horizon", environment.horizon, nonNegative);
        environment.ground = object.triple("ground", environment.ground, nonNegative);
        const std::string image = object.text("image");
        object.finish();
        if (!object.has("image")) {
            return;
        }
        const std::filesystem::path target = object.namedFile("image", image, "an existing .hdr or .exr file");
        scene_.inputs.push_back(target.string());
        environment.file = target.string();
        environment.image = readRadiance(target);
        const auto isRadiance = [](float value) { return value >= 0 && std::isfinite(value); };
        if (!std::ranges::all_of(environment.image->values, isRadiance)) {
            object.refuse("image", "an image without negative, infinite and NaN pixels");
        }
    }

    std::filesystem::path path_;
    SceneFileObject root_;
    std::optional<double> time_;
    Scene scene_;
};

} // namespace

Scene readSceneFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                    std::optional<double> time) {
    const nlohmann::json json = parseSceneJson(file.string(), bytes);
    return SceneFileReader(file, SceneFileObject(json, file.string(), ""), time).read();
}

} // namespace nacre::scene
