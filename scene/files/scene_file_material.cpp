#include "scene/files/scene_file_material.hpp"

#include "nacre/files.hpp"
#include "nacre/presets.hpp"
#include "scene/surface_material.hpp"
#include "scene/texture.hpp"

#include <algorithm>
#include <map>

namespace nacre::scene {
namespace {

/// The index of the material among the model's, to which it is added; `none` for null.
std::uint32_t addMaterial(const SceneFileObject& object, const char* key, const nlohmann::json& value, Scene& model) {
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
    constexpr const char* expected = "a preset's name, an existing material file, a material or null";
    if (!value.is_string()) {
        object.refuse(key, expected);
    }
    const auto target = object.namedFile(key, value.get<std::string>(), expected);
    model.inputs.push_back(target.string());
    return addMaterial(model, loadMaterial(target), where);
}

using Surfaces = std::vector<Surface*>;

/// Calls `use` with every entry of the member `key`, and the surfaces that have its name.
template <typename Use>
void forEachName(const SceneFileObject& object, const char* key, const nlohmann::json& byName, Scene& model,
                 const Use& use) {
    const SceneFileObject entries(byName, object.file(), object.fieldOf(key));
    std::map<std::string, Surfaces> surfaces;
    for (Surface& surface : model.surfaces) {
        surfaces[surface.name].push_back(&surface);
    }
    for (const auto& [name, value] : byName.items()) {
        const auto named = surfaces.find(name);
        if (named == surfaces.end()) {
            throw SceneError(object.file() + ": " + entries.fieldOf(name) + ": the model has no such surface, only " +
                             listNames(model.surfaces));
        }
        use(entries, name, value, named->second);
    }
}

void assignByName(const SceneFileObject& object, const nlohmann::json& byName, Scene& model) {
    forEachName(object, "materials", byName, model,
                [&](const SceneFileObject& entries, const std::string& name, const nlohmann::json& value,
                    const Surfaces& surfaces) {
                    const std::uint32_t material = addMaterial(entries, name.c_str(), value, model);
                    for (Surface* surface : surfaces) {
                        setSurfaceMaterial(model, *surface, material);
                    }
                });
}

/// Gives the surfaces the picture that the member names, where the model's own lies or would.
void readLookTexture(SceneFileObject& look, const LookTexture& kind, Scene& model, const Surfaces& surfaces) {
    const std::string file = look.text(kind.key);
    if (!look.has(kind.key)) {
        return;
    }
    const std::filesystem::path target = look.namedFile(kind.key, file, "an existing picture of 8 bits");
    model.inputs.push_back(target.string());
    for (Surface* surface : surfaces) {
        surface->*kind.texture = static_cast<std::uint32_t>(model.textures.size());
    }
    model.textures.push_back(readTexture(target, kind.srgb));
}

void readLook(SceneFileObject look, Scene& model, const Surfaces& surfaces) {
    const bool colored = look.has("baseColor");
    const glm::vec3 baseColor = look.triple("baseColor", glm::vec3(1), unitInterval);
    for (const auto& [key, member] :
         {std::pair("metallic", &Surface::metallic), std::pair("roughness", &Surface::roughness),
          std::pair("specular", &Surface::specular)}) {
        const float value = look.real(key, 0, unitInterval);
        for (Surface* surface : surfaces) {
            surface->*member = look.has(key) ? value : surface->*member;
        }
    }
    const float thickness = look.real("thickness", -1, {0, 1e6});
    const float scale = look.real("scale", 1, {1e-3, 1e3});
    const bool doubleSided = look.boolean("doubleSided", false);
    for (Surface* surface : surfaces) {
        surface->baseColor = colored ? glm::vec4(baseColor, surface->baseColor.w) : surface->baseColor;
        surface->thickness = thickness >= 0 ? thickness : surface->thickness;
        surface->scale = look.has("scale") ? scale : surface->scale;
        surface->doubleSided = look.has("doubleSided") ? doubleSided : surface->doubleSided;
    }
    if (look.has("thicknessTexture")) { // which is a share of it
        look.require("thickness");
    }
    for (const LookTexture& texture : lookTextures) {
        readLookTexture(look, texture, model, surfaces);
    }
    look.finish();
}

} // namespace

void assignMaterials(SceneFileObject& object, Scene& model) {
    if (const nlohmann::json* material = object.member("material")) {
        const std::uint32_t index = addMaterial(object, "material", *material, model);
        setBodyMaterial(model, index, object.file() + ": " + object.fieldOf("material"));
    }
    if (const nlohmann::json* byName = object.member("materials")) {
        assignByName(object, *byName, model);
    }
    Surfaces all;
    for (Surface& surface : model.surfaces) {
        all.push_back(&surface);
    }
    readLook(object.object("surface"), model, all);
    if (const nlohmann::json* byName = object.member("surfaces")) {
        forEachName(object, "surfaces", *byName, model,
                    [&](const SceneFileObject& entries, const std::string& name, const nlohmann::json& value,
                        const Surfaces& surfaces) {
                        readLook(SceneFileObject(value, object.file(), entries.fieldOf(name)), model, surfaces);
                    });
    }
}

} // namespace nacre::scene
