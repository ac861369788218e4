#include "app/render_scene.hpp"

#include "app/command.hpp"
#include "app/material_source.hpp"
#include "app/terminal_text.hpp"
#include "core/files/quoted_text.hpp"
#include "scene/default_view.hpp"
#include "scene/gallery/gallery.hpp"
#include "scene/import.hpp"
#include "scene/surface_material.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <set>
#include <span>

namespace nacre::app {

namespace {

using scene::Camera;
using scene::Light;
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

/// Marks the lights on that side; false when there is none.
bool markSide(Side side, const std::vector<Light>& lights, const Camera& camera, const glm::vec3& center,
              std::vector<bool>& marks) {
    bool any = false;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const bool isThere = side == Side::Both || scene::isInFront(lights[i], camera, center) == (side == Side::Front);
        marks[i] = marks[i] || isThere;
        any = any || isThere;
    }
    return any;
}

std::vector<Light> marked(const std::vector<Light>& lights, const std::vector<bool>& marks) {
    std::vector<Light> result;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (marks[i]) {
            result.push_back(lights[i]);
        }
    }
    return result;
}

std::optional<std::size_t> parseIndex(const std::string& text) {
    if (text.empty() || text.size() > 6 || !std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; })) {
        return std::nullopt;
    }
    return std::stoul(text);
}

Camera findCamera(const SceneOptions& options, const Scene& scene) {
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

void chooseLights(const SceneOptions& options, Scene& scene) {
    if (options.lights.empty()) {
        return;
    }
    const Camera camera = makeCamera(options, scene);
    const glm::vec3 center = scene::bounds(scene).center();
    const std::vector<Light> builtIn = scene::builtInLights(scene);
    std::vector<bool> chosen(scene.lights.size()); // so that what is named twice shines once
    std::vector<bool> added(builtIn.size());
    for (const std::string& name : options.lights) {
        if (const std::optional<Side> side = sideNamed(name)) {
            if (!markSide(*side, scene.lights, camera, center, chosen)) {
                markSide(*side, builtIn, camera, center, added);
            }
            continue;
        }
        const auto light = std::ranges::find(scene.lights, name, &Light::name);
        if (light == scene.lights.end()) {
            throw std::runtime_error(sceneName(options) + ": has no light '" + name + "', only " +
                                     listNames(scene.lights));
        }
        chosen[static_cast<std::size_t>(light - scene.lights.begin())] = true;
    }
    scene.lights = marked(scene.lights, chosen);
    std::ranges::copy(marked(builtIn, added), std::back_inserter(scene.lights));
}

std::string sceneName(const SceneOptions& options) {
    return options.input.empty() ? "gallery" : options.input.string();
}

Scene makeScene(const SceneOptions& options) {
    std::optional<Material> material;
    if (!options.material.empty()) {
        material = readMaterial(options.material);
    }
    if (options.time && options.input.empty()) {
        throw UsageError("--time needs a scene with an animation, and the gallery has none");
    }
    Scene scene = options.input.empty() ? scene::makeGallery() : scene::load(options.input, options.time);
    if (material) {
        scene::assignMaterial(scene, *material);
    }
    const std::set notes(scene.notes.begin(), scene.notes.end());
    scene.notes.assign(notes.begin(), notes.end());
    chooseLights(options, scene);
    return scene;
}

void printNotes(const std::vector<std::string>& notes) {
    constexpr std::size_t most = 50;
    for (const std::string& note : std::span(notes).first(std::min(most, notes.size()))) {
        std::cerr << "nacre: note: " << printable(note) << '\n';
    }
    if (notes.size() > most) {
        std::cerr << "nacre: note: " << notes.size() - most << " more notes stand in the report of --json\n";
    }
}

void requireInputsKept(const SceneOptions& options, const Scene& scene, std::vector<std::filesystem::path> outputs) {
    std::erase_if(outputs, [](const auto& file) { return file.empty() || file == "-"; });
    for (const std::string& input : scene.inputs) {
        for (const std::filesystem::path& output : outputs) {
            if (isSameFile(input, output)) {
                throw std::runtime_error(output.string() + ": cannot be written: " + sceneName(options) +
                                         " is made of this file");
            }
        }
    }
}

Camera makeCamera(const SceneOptions& options, const Scene& scene) {
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
