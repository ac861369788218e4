#include "scene/files/scene_file_models.hpp"

#include "scene/files/scene_file_material.hpp"
#include "scene/gallery/gallery.hpp"
#include "scene/import.hpp"
#include "scene/length_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace nacre::scene {
namespace {

/// The model that no file holds.
constexpr const char* galleryName = "gallery";

glm::vec3 readScale(SceneFileObject& model) {
    const nlohmann::json* value = model.member("scale");
    if (value != nullptr && value->is_array()) {
        return model.triple("scale", glm::vec3(1), positive);
    }
    return glm::vec3(model.real("scale", 1, positive));
}

/// translate · rotate about z · about y · about x · scale
glm::dmat4 readTransform(SceneFileObject& model) {
    const glm::dvec3 scale = readScale(model);
    const glm::dvec3 angles = model.triple("rotate", glm::vec3(0)) * degree;
    glm::dmat4 transform = glm::translate(glm::dmat4(1), glm::dvec3(model.triple("translate", glm::vec3(0))));
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
            for (const TextureSlot& slot : textureSlots) {
                mark(textures, model.surfaces[i].*slot.texture);
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
        for (const TextureSlot& slot : textureSlots) {
            follow(surface.*slot.texture, movedTextures);
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
    const auto kept = names->get<std::set<std::string>>();
    std::set<std::string> known;
    for (const Instance& instance : model.instances) {
        known.insert(instance.name);
    }
    if (!std::ranges::includes(known, kept)) {
        object.refuse("instances", "of " + listNames(model.instances));
    }
    std::erase_if(model.instances, [&](const Instance& instance) { return !kept.contains(instance.name); });
}

/// Everything of an entry but where it stands and what it is called.
std::string looksOf(const SceneFileObject& object) {
    nlohmann::json looks = object.json();
    for (const char* place : {"translate", "rotate", "scale", "name"}) {
        looks.erase(place);
    }
    return looks.dump();
}

std::filesystem::path fileOf(const SceneFileObject& object, const std::string& source) {
    return object.namedFile("model", source, "\"gallery\" or an existing file");
}

/// One text for all spellings of a model's name.
std::string keyOf(const SceneFileObject& object, const std::string& source) {
    return source == galleryName ? source : std::filesystem::canonical(fileOf(object, source)).string();
}

Scene loadNamed(const SceneFileObject& object, const std::string& source, std::optional<double> time) {
    const std::filesystem::path target = fileOf(object, source);
    Scene model = loadModel(target, time);
    model.inputs.push_back(target.string());
    return model;
}

/// Moves instances, lights and cameras, and puts `name` before the instances' own.
void place(Scene& model, const glm::dmat4& fromFile, const std::string& name) {
    const glm::dmat4 fromOrigin = glm::translate(fromFile, model.origin);
    const glm::mat4 transform(fromOrigin);
    for (Instance& instance : model.instances) {
        instance.transform = fromOrigin * glm::dmat4(instance.transform);
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
}

} // namespace

void SceneFileModels::add(std::vector<SceneFileObject>& models) {
    std::set<std::string> looks;
    for (SceneFileObject& model : models) {
        model.require("model");
        if (looks.insert(looksOf(model)).second) {
            ++placements_[keyOf(model, model.text("model"))];
        }
    }
    for (std::size_t entry = 0; entry < models.size(); ++entry) {
        addModel(models[entry], static_cast<std::uint32_t>(entry));
    }
}

void SceneFileModels::addModel(SceneFileObject& object, std::uint32_t entry) {
    const std::string source = object.text("model");
    if (const auto shared = placed_.find(looksOf(object)); shared != placed_.end()) {
        placeAgain(object, shared->second);
        return;
    }
    const std::string key = keyOf(object, source);
    Scene model = take(object, source, key);
    std::array<const char*, lengthUnits.size()> unitNames{};
    std::ranges::transform(lengthUnits, unitNames.begin(), &LengthUnit::name);
    const std::size_t unit = object.choice("units", 0, unitNames);
    if (object.has("units")) {
        model.metersPerUnit = lengthUnits[unit].metres;
        std::erase_if(model.notes, [](const std::string& note) { return note.find(unitNote) != std::string::npos; });
    }
    keepInstances(object, model);
    assignMaterials(object, model);
    dropUnused(model);
    const auto unitScale = static_cast<float>(model.metersPerUnit / scene_.metersPerUnit);
    const glm::dmat4 transform = readTransform(object) * glm::scale(glm::dmat4(1), glm::dvec3(unitScale));
    const std::string name = object.text("name");
    object.finish();
    // What is placed again as it is here needs no more than its instances, lights and cameras.
    Placed placed{model.instances, model.lights, model.cameras, unitScale, model.origin};
    for (Instance& instance : placed.instances) {
        instance.mesh += static_cast<std::uint32_t>(scene_.meshes.size());
    }
    placed_.emplace(looksOf(object), std::move(placed));
    charge(model, key);
    for (Surface& surface : model.surfaces) {
        surface.model = entry;
    }
    append(std::move(model), transform, name);
}

/// Places a model that is there already, with the looks it has.
void SceneFileModels::placeAgain(SceneFileObject& object, const Placed& placed) {
    const glm::dmat4 transform = readTransform(object) * glm::scale(glm::dmat4(1), glm::dvec3(placed.unitScale));
    const std::string name = object.text("name");
    for (const char* known : {"model", "units", "instances", "material", "materials", "surface", "surfaces"}) {
        object.member(known);
    }
    object.finish();
    Scene again;
    again.instances = placed.instances;
    again.lights = placed.lights;
    again.cameras = placed.cameras;
    again.origin = placed.origin;
    place(again, transform, name);
    takeOver(std::move(again));
}

/// Bounds what all models take together: one that is placed with other looks than before is a copy.
void SceneFileModels::charge(const Scene& model, const std::string& key) {
    if (seen_.insert(key).second) {
        for (const std::string& input : model.inputs) {
            std::error_code error;
            const std::uintmax_t size = std::filesystem::file_size(input, error);
            budget_.addInput(error ? 0 : size);
        }
    }
    std::ranges::for_each(model.meshes, [this](const Mesh& mesh) { budget_.charge(mesh); });
    std::ranges::for_each(model.textures, [this](const Texture& texture) { budget_.charge(texture); });
}

/// Built or read once, however often it is placed: that can take seconds.
Scene SceneFileModels::take(const SceneFileObject& object, const std::string& source, const std::string& key) {
    const auto [model, isNew] = models_.try_emplace(key);
    if (isNew) {
        model->second = source == galleryName ? makeGallery() : loadNamed(object, source, time_);
    }
    return --placements_[key] == 0 ? std::move(model->second) : model->second;
}

void SceneFileModels::append(Scene model, const glm::dmat4& transform, const std::string& name) {
    const auto shift = [](std::uint32_t& index, std::size_t by) {
        index = index == none ? none : index + static_cast<std::uint32_t>(by);
    };
    for (Surface& surface : model.surfaces) {
        for (const TextureSlot& slot : textureSlots) {
            shift(surface.*slot.texture, scene_.textures.size());
        }
        shift(surface.material, scene_.materials.size());
    }
    for (Mesh& mesh : model.meshes) {
        shift(mesh.surface, scene_.surfaces.size());
    }
    for (Instance& instance : model.instances) {
        shift(instance.mesh, scene_.meshes.size());
    }
    place(model, transform, name);
    takeOver(std::move(model));
}

void SceneFileModels::takeOver(Scene model) {
    std::ranges::for_each(model.instances, [this](const Instance& instance) { budget_.charge(instance); });
    budget_.charge(model.lights.size() * sizeof(Light) + model.cameras.size() * sizeof(Camera));
    const auto move = [](auto& from, auto& to) { std::ranges::move(from, std::back_inserter(to)); };
    move(model.textures, scene_.textures);
    move(model.materials, scene_.materials);
    move(model.surfaces, scene_.surfaces);
    move(model.meshes, scene_.meshes);
    move(model.instances, scene_.instances);
    move(model.lights, scene_.lights);
    move(model.cameras, scene_.cameras);
    move(model.notes, scene_.notes);
    move(model.inputs, scene_.inputs);
}

} // namespace nacre::scene
