#include "scene/files/scene_file.hpp"

#include "image/image_file.hpp"
#include "nacre/files.hpp"
#include "scene/files/scene_file_material.hpp"
#include "scene/files/scene_file_object.hpp"
#include "scene/gallery/gallery.hpp"
#include "scene/import.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numbers>

namespace nacre::scene {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;

struct Unit {
    const char* name;
    double metres;
};
constexpr std::array units{Unit{"m", 1}, Unit{"cm", 0.01}, Unit{"mm", 0.001}, Unit{"in", 0.0254}, Unit{"ft", 0.3048}};

void checkDirection(const SceneFileObject& object, const char* key, const glm::vec3& direction) {
    if (!(glm::length(direction) > 0)) {
        object.refuse(key, "a direction other than (0, 0, 0)");
    }
}

glm::vec3 readScale(SceneFileObject& model) {
    const nlohmann::json* value = model.member("scale");
    if (value != nullptr && value->is_array()) {
        return model.triple("scale", glm::vec3(1), positive);
    }
    return glm::vec3(model.real("scale", 1, positive));
}

/// translate · rotate about z · about y · about x · scale
glm::mat4 readTransform(SceneFileObject& model) {
    const glm::vec3 scale = readScale(model);
    const glm::vec3 angles = model.triple("rotate", glm::vec3(0)) * degree;
    glm::mat4 transform = glm::translate(glm::mat4(1), model.triple("translate", glm::vec3(0)));
    transform = glm::rotate(transform, angles.z, {0, 0, 1});
    transform = glm::rotate(transform, angles.y, {0, 1, 0});
    transform = glm::rotate(transform, angles.x, {1, 0, 0});
    return glm::scale(transform, scale);
}

/// Keeps of `items` those that are marked; the result says where each has gone.
template <typename T> std::vector<std::uint32_t> keepMarked(std::vector<T>& items, const std::vector<bool>& marked) {
    std::vector<std::uint32_t> moved(items.size(), none);
    std::vector<T> kept;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (marked[i]) {
            moved[i] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(std::move(items[i]));
        }
    }
    items = std::move(kept);
    return moved;
}

/// The textures a surface refers to.
std::array<std::uint32_t*, 4> texturesOf(Surface& surface) {
    return {&surface.baseColorTexture, &surface.normalTexture, &surface.metallicRoughnessTexture,
            &surface.thicknessTexture};
}

/// Drops meshes, surfaces, materials and textures that no instance uses.
void dropUnused(Scene& model) {
    std::vector<bool> meshes(model.meshes.size());
    std::vector<bool> surfaces(model.surfaces.size());
    std::vector<bool> materials(model.materials.size());
    std::vector<bool> textures(model.textures.size());
    for (const Instance& instance : model.instances) {
        meshes[instance.mesh] = true;
        surfaces[model.meshes[instance.mesh].surface] = true;
    }
    const auto mark = [](std::vector<bool>& marks, std::uint32_t index) {
        if (index != none) {
            marks[index] = true;
        }
    };
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        if (surfaces[i]) {
            mark(materials, model.surfaces[i].material);
            for (const std::uint32_t* texture : texturesOf(model.surfaces[i])) {
                mark(textures, *texture);
            }
        }
    }
    const auto follow = [](std::uint32_t& index, const std::vector<std::uint32_t>& moved) {
        index = index == none ? none : moved[index];
    };
    const auto movedMeshes = keepMarked(model.meshes, meshes);
    const auto movedSurfaces = keepMarked(model.surfaces, surfaces);
    const auto movedMaterials = keepMarked(model.materials, materials);
    const auto movedTextures = keepMarked(model.textures, textures);
    for (Instance& instance : model.instances) {
        follow(instance.mesh, movedMeshes);
    }
    for (Mesh& mesh : model.meshes) {
        follow(mesh.surface, movedSurfaces);
    }
    for (Surface& surface : model.surfaces) {
        follow(surface.material, movedMaterials);
        for (std::uint32_t* texture : texturesOf(surface)) {
            follow(*texture, movedTextures);
        }
    }
}

/// Drops the instances that are not named.
void keepInstances(SceneFileObject& object, Scene& model) {
    const nlohmann::json* names = object.member("instances");
    if (names == nullptr) {
        return;
    }
    if (!names->is_array() || names->empty() ||
        !std::ranges::all_of(*names, [](const auto& n) { return n.is_string(); })) {
        object.refuse("instances", "an array of names");
    }
    const auto kept = names->get<std::vector<std::string>>();
    std::string known;
    for (const Instance& instance : model.instances) {
        known += (known.empty() ? "\"" : ", \"") + instance.name + "\"";
    }
    for (const std::string& name : kept) {
        if (std::ranges::find(model.instances, name, &Instance::name) == model.instances.end()) {
            object.refuse("instances", "of " + known);
        }
    }
    std::erase_if(model.instances,
                  [&](const Instance& instance) { return std::ranges::find(kept, instance.name) == kept.end(); });
}

class SceneFileReader {
public:
    SceneFileReader(const std::filesystem::path& file, SceneFileObject root) : path_(file), root_(std::move(root)) {}

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
        for (SceneFileObject& model : models) {
            ++placements_[model.text("model")];
        }
        for (SceneFileObject& model : models) {
            addModel(model);
        }
        std::vector<Light> lights;
        for (SceneFileObject& light : root_.objects("lights")) {
            lights.push_back(readLight(light));
        }
        std::vector<Camera> cameras;
        for (SceneFileObject& camera : root_.objects("cameras")) {
            cameras.push_back(readCamera(camera));
        }
        if (!lights.empty()) {
            scene_.lights = std::move(lights);
        }
        if (!cameras.empty()) {
            scene_.cameras = std::move(cameras);
        }
        SceneFileObject environment = root_.object("environment");
        readEnvironment(environment);
        root_.finish();
        return std::move(scene_);
    }

private:
    void addModel(SceneFileObject& object) {
        object.require("model");
        const std::string source = object.text("model");
        Scene model = takeModel(object, source);
        std::array<const char*, units.size()> unitNames{};
        std::ranges::transform(units, unitNames.begin(), &Unit::name);
        const std::size_t unit = object.choice("units", 0, unitNames);
        if (object.has("units")) {
            model.metersPerUnit = units[unit].metres;
            std::erase_if(model.notes,
                          [](const std::string& note) { return note.find(unitNote) != std::string::npos; });
        }
        keepInstances(object, model);
        assignMaterials(path_, object, model);
        dropUnused(model);
        const auto unitScale = static_cast<float>(model.metersPerUnit / scene_.metersPerUnit);
        const glm::mat4 transform = readTransform(object) * glm::scale(glm::mat4(1), glm::vec3(unitScale));
        const std::string name = object.text("name");
        object.finish();
        append(std::move(model), transform, name);
    }

    /// Built or read once, however often it is placed: that can take seconds.
    Scene takeModel(const SceneFileObject& object, const std::string& source) {
        const auto [model, isNew] = models_.try_emplace(source);
        if (isNew) {
            model->second = source == "gallery" ? makeGallery() : loadNamed(object, source);
        }
        return --placements_[source] == 0 ? std::move(model->second) : model->second;
    }

    Scene loadNamed(const SceneFileObject& object, const std::string& source) {
        const std::filesystem::path target = path_.parent_path() / source;
        if (source.empty() || !std::filesystem::exists(target)) {
            object.refuse("model", "\"gallery\" or an existing file");
        }
        return loadModel(target);
    }

    void append(Scene model, const glm::mat4& transform, const std::string& name) {
        const auto shift = [](std::uint32_t& index, std::size_t by) {
            index = index == none ? none : index + static_cast<std::uint32_t>(by);
        };
        for (Surface& surface : model.surfaces) {
            for (std::uint32_t* texture : texturesOf(surface)) {
                shift(*texture, scene_.textures.size());
            }
            shift(surface.material, scene_.materials.size());
        }
        for (Mesh& mesh : model.meshes) {
            shift(mesh.surface, scene_.surfaces.size());
        }
        for (Instance& instance : model.instances) {
            shift(instance.mesh, scene_.meshes.size());
            instance.transform = transform * instance.transform;
            instance.name = name.empty() ? instance.name : name + (instance.name.empty() ? "" : "/" + instance.name);
        }
        const float length = std::cbrt(std::abs(glm::determinant(glm::mat3(transform))));
        for (Light& light : model.lights) {
            light.position = glm::vec3(transform * glm::vec4(light.position, 1));
            light.direction = glm::normalize(glm::mat3(transform) * light.direction);
        }
        for (Camera& camera : model.cameras) {
            camera.position = glm::vec3(transform * glm::vec4(camera.position, 1));
            camera.target = glm::vec3(transform * glm::vec4(camera.target, 1));
            camera.up = glm::normalize(glm::mat3(transform) * camera.up);
            camera.orthographicHeight *= length;
            camera.nearPlane *= length;
            camera.farPlane *= length;
        }
        const auto move = [](auto& from, auto& to) { std::ranges::move(from, std::back_inserter(to)); };
        move(model.textures, scene_.textures);
        move(model.materials, scene_.materials);
        move(model.surfaces, scene_.surfaces);
        move(model.meshes, scene_.meshes);
        move(model.instances, scene_.instances);
        move(model.lights, scene_.lights);
        move(model.cameras, scene_.cameras);
        move(model.notes, scene_.notes);
    }

    static Light readLight(SceneFileObject& object) {
        constexpr std::array kinds{"directional", "spot", "point"};
        Light light;
        light.name = object.text("name");
        object.require("type");
        light.kind = static_cast<LightKind>(object.choice("type", 0, kinds));
        light.color = object.triple("color", light.color, nonNegative);
        light.intensity = object.real("intensity", light.intensity, nonNegative);
        light.position = object.triple("position", light.position);
        if (light.kind != LightKind::Point) {
            object.require("direction");
        }
        if (light.kind != LightKind::Directional) {
            object.require("position");
        }
        light.direction = object.triple("direction", light.direction);
        checkDirection(object, "direction", light.direction);
        light.direction = glm::normalize(light.direction);
        light.range = object.real("range", light.range, nonNegative);
        light.outerConeAngle = object.real("outerConeAngle", 45, {0, 90, true}) * degree;
        light.innerConeAngle = object.real("innerConeAngle", 0, {0, 90}) * degree;
        if (light.innerConeAngle > light.outerConeAngle) {
            object.refuse("innerConeAngle", "at most outerConeAngle");
        }
        light.castsShadow = object.boolean("castsShadow", light.castsShadow);
        object.finish();
        return light;
    }

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
        const std::filesystem::path target = path_.parent_path() / image;
        if (image.empty() || !std::filesystem::exists(target)) {
            object.refuse("image", "an existing .hdr or .exr file");
        }
        environment.image = readRadiance(target);
        const auto isRadiance = [](float value) { return value >= 0 && std::isfinite(value); };
        if (!std::ranges::all_of(environment.image->values, isRadiance)) {
            object.refuse("image", "an image without negative, infinite and NaN pixels");
        }
    }

    std::filesystem::path path_;
    SceneFileObject root_;
    Scene scene_;
    std::map<std::string, int> placements_; ///< of each model that are left
    std::map<std::string, Scene> models_;
};

} // namespace

Scene readSceneFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
    const nlohmann::json json = parseSceneJson(file.string(), bytes);
    return SceneFileReader(file, SceneFileObject(json, file.string(), "")).read();
}

} // namespace nacre::scene
