#include "scene/files/scene_file_material.hpp"

#include "nacre/files.hpp"
#include "nacre/presets.hpp"
#include "scene/surface_material.hpp"

#include <algorithm>

namespace nacre::scene {
namespace {

/// The index of the material among the model's, to which it is added; `none` for null.
std::uint32_t addMaterial(const std::filesystem::path& sceneFile, const SceneFileObject& object, const char* key,
                          const nlohmann::json& value, Scene& model) {
    if (value.is_null()) {
        return none;
    }
    const std::string where = object.file() + ": " + object.fieldOf(key);
    if (value.is_object()) {
        return addMaterial(model, parseMaterial(value.dump(), where), where);
    }
    if (const Material* preset = value.is_string() ? findPreset(value.get<std::string>()) : nullptr) {
        return addMaterial(model, *preset, where);
    }
    const auto target =
        value.is_string() ? sceneFile.parent_path() / value.get<std::string>() : std::filesystem::path();
    if (!std::filesystem::is_regular_file(target)) {
        object.refuse(key, "a preset's name, an existing material file, a material or null");
    }
    return addMaterial(model, loadMaterial(target), where);
}

void assignByName(const std::filesystem::path& sceneFile, SceneFileObject& object, const nlohmann::json& byName,
                  Scene& model) {
    SceneFileObject entries(byName, object.file(), object.fieldOf("materials"));
    for (const auto& [name, value] : byName.items()) {
        const std::uint32_t material = addMaterial(sceneFile, entries, name.c_str(), value, model);
        bool found = false;
        std::string known;
        for (Surface& surface : model.surfaces) {
            known += (known.empty() ? "\"" : ", \"") + surface.name + "\"";
            if (surface.name == name) {
                setSurfaceMaterial(model, surface, material);
                found = true;
            }
        }
        if (!found) {
            throw SceneError(object.file() + ": " + entries.fieldOf(name) + ": the model has no such surface, only " +
                             known);
        }
    }
}

void readLook(SceneFileObject look, Scene& model) {
    const bool colored = look.has("baseColor");
    const glm::vec3 baseColor = look.triple("baseColor", glm::vec3(1), unitInterval);
    for (const auto& [key, member] :
         {std::pair("metallic", &Surface::metallic), std::pair("roughness", &Surface::roughness),
          std::pair("specular", &Surface::specular)}) {
        const float value = look.real(key, 0, unitInterval);
        for (Surface& surface : model.surfaces) {
            surface.*member = look.has(key) ? value : surface.*member;
        }
    }
    const float thickness = look.real("thickness", -1, {0, 1e6});
    const bool doubleSided = look.boolean("doubleSided", false);
    for (Surface& surface : model.surfaces) {
        surface.baseColor = colored ? glm::vec4(baseColor, surface.baseColor.w) : surface.baseColor;
        surface.thickness = thickness >= 0 ? thickness : surface.thickness;
        surface.doubleSided = look.has("doubleSided") ? doubleSided : surface.doubleSided;
    }
    look.finish();
}

} // namespace

void assignMaterials(const std::filesystem::path& sceneFile, SceneFileObject& object, Scene& model) {
    if (const nlohmann::json* material = object.member("material")) {
        const std::uint32_t index = addMaterial(sceneFile, object, "material", *material, model);
        for (Surface& surface : model.surfaces) {
            setSurfaceMaterial(model, surface, index);
        }
    }
    if (const nlohmann::json* byName = object.member("materials")) {
        assignByName(sceneFile, object, *byName, model);
    }
    readLook(object.object("surface"), model);
}

} // namespace nacre::scene
