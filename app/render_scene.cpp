#include "app/render_scene.hpp"

#include "app/command.hpp"
#include "app/material_source.hpp"
#include "scene/gallery.hpp"
#include "scene/import.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <set>

namespace nacre::app {

namespace {

using scene::Camera;
using scene::Light;
using scene::LightKind;
using scene::Scene;

enum class Side { Front, Back, Both };

std::optional<Side> sideNamed(std::string_view name) {
    if (name == "front") {
        return Side::Front;
    }
    if (name == "back") {
        return Side::Back;
    }
    return name == "both" ? std::optional(Side::Both) : std::nullopt;
}

Side sideOf(const Light& light, const Camera& camera, const glm::vec3& center) {
    const glm::vec3 travel = light.kind == LightKind::Directional ? light.direction : center - light.position;
    return glm::dot(travel, camera.target - camera.position) >= 0 ? Side::Front : Side::Back;
}

std::vector<Light> lightsOn(Side side, const Scene& scene, const Camera& camera) {
    const glm::vec3 center = scene::bounds(scene).center();
    std::vector<Light> result;
    std::ranges::copy_if(scene.lights, std::back_inserter(result), [&](const Light& light) {
        return side == Side::Both || sideOf(light, camera, center) == side;
    });
    return result;
}

/// The scene's lights on that side, or the built-in ones where it has none there.
std::vector<Light> someLightsOn(Side side, const Scene& scene, const Camera& camera) {
    std::vector<Light> lights = lightsOn(side, scene, camera);
    if (lights.empty()) {
        Scene bare = scene;
        bare.lights.clear();
        scene::addMissingViewAndLights(bare);
        lights = lightsOn(side, bare, camera);
    }
    return lights;
}

template <typename Item> std::string listNames(const std::vector<Item>& items) {
    std::string result;
    for (const Item& item : items) {
        result += (result.empty() ? "'" : ", '") + item.name + "'";
    }
    return result.empty() ? "none" : result;
}

std::optional<std::size_t> parseIndex(const std::string& text) {
    if (text.empty() || text.size() > 6 || !std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; })) {
        return std::nullopt;
    }
    return std::stoul(text);
}

Camera findCamera(const RenderOptions& options, const Scene& scene) {
    if (options.camera.empty()) {
        return scene.cameras.at(0);
    }
    const auto named = std::ranges::find(scene.cameras, options.camera, &Camera::name);
    if (named != scene.cameras.end()) {
        return *named;
    }
    const std::optional<std::size_t> index = parseIndex(options.camera);
    if (!index || *index >= scene.cameras.size()) {
        throw std::runtime_error(sceneName(options) + ": has no camera '" + options.camera + "', only 0 to " +
                                 std::to_string(scene.cameras.size() - 1) + ": " + listNames(scene.cameras));
    }
    return scene.cameras[*index];
}

} // namespace

void chooseLights(const RenderOptions& options, Scene& scene) {
    if (options.lights.empty()) {
        return;
    }
    const Camera camera = makeCamera(options, scene);
    std::vector<Light> chosen;
    for (const std::string& name : options.lights) {
        if (const std::optional<Side> side = sideNamed(name)) {
            std::ranges::copy(someLightsOn(*side, scene, camera), std::back_inserter(chosen));
            continue;
        }
        const auto light = std::ranges::find(scene.lights, name, &Light::name);
        if (light == scene.lights.end()) {
            throw std::runtime_error(sceneName(options) + ": has no light '" + name + "', only " +
                                     listNames(scene.lights));
        }
        chosen.push_back(*light);
    }
    scene.lights = std::move(chosen);
}

std::string sceneName(const RenderOptions& options) {
    return options.input.empty() ? "gallery" : options.input.string();
}

Scene makeScene(const RenderOptions& options) {
    std::optional<Material> material;
    if (!options.material.empty()) {
        material = readMaterial(options.material);
    }
    Scene scene = options.input.empty() ? scene::makeGallery() : scene::load(options.input);
    for (const std::string& note : std::set(scene.notes.begin(), scene.notes.end())) {
        std::cerr << "nacre: note: " << note << '\n';
    }
    if (material) {
        scene::assignMaterial(scene, *material);
    }
    chooseLights(options, scene);
    scene.exposure *= std::exp2(options.exposure);
    return scene;
}

Camera makeCamera(const RenderOptions& options, const Scene& scene) {
    Camera camera = findCamera(options, scene);
    camera.position = options.cameraPosition.value_or(camera.position);
    camera.target = options.cameraTarget.value_or(camera.target);
    if (options.cameraPosition || options.cameraTarget) {
        camera.nearPlane = 0;
        camera.farPlane = 0;
    }
    if (options.fieldOfView) {
        camera.projection = scene::ProjectionKind::Perspective;
        camera.verticalFieldOfView = *options.fieldOfView;
    }
    const glm::vec3 view = camera.target - camera.position;
    if (!(glm::length(view) > 0)) {
        throw std::runtime_error("the camera's position and target are the same point");
    }
    if (glm::length(glm::cross(view, camera.up)) <= 1e-6F * glm::length(view) * glm::length(camera.up)) {
        camera.up = std::abs(glm::normalize(view).y) > 0.9F ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    }
    return camera;
}

} // namespace nacre::app
