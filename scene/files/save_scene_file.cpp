#include "scene/files/save_scene_file.hpp"

#include "core/files/quoted_text.hpp"
#include "nacre/presets.hpp"
#include "scene/files/scene_file_light.hpp"
#include "scene/files/scene_file_material.hpp"
#include "scene/import.hpp"
#include "scene/surface_material.hpp"

#include <algorithm>
#include <set>

namespace nacre::scene {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json cameraJson(const Camera& camera) {
    return {{"name", camera.name},
            {"position", shortTriple(camera.position)},
            {"target", shortTriple(camera.target)},
            {"up", shortTriple(camera.up)},
            {"offCenter", {shortNumber(camera.offCenter.x), shortNumber(camera.offCenter.y)}},
            {"nearPlane", shortNumber(camera.nearPlane)},
            {"farPlane", shortNumber(camera.farPlane)},
            {"projection", camera.projection == ProjectionKind::Orthographic ? "orthographic" : "perspective"},
            {"orthographicHeight", shortNumber(camera.orthographicHeight)},
            {"verticalFieldOfView", degreesOf(camera.verticalFieldOfView)}};
}

/// The four numbers of a look that a material sets, too.
Json lookJson(const Surface& surface) {
    return {{"baseColor", shortTriple(glm::vec3(surface.baseColor))},
            {"metallic", shortNumber(surface.metallic)},
            {"roughness", shortNumber(surface.roughness)},
            {"specular", shortNumber(surface.specular)}};
}

Json materialJson(const Material& material) {
    const Material* preset = findPreset(material.name);
    return preset != nullptr && *preset == material ? Json(material.name) : Json::parse(formatMaterial(material));
}

class SceneFileWriter {
public:
    SceneFileWriter(const Scene& scene, const std::vector<Surface>& read, const fs::path& source,
                    const fs::path& target)
        : scene_(scene),
          read_(read),
          source_(source),
          target_(target),
          sourceIsScene_(!source.empty() && isSceneFile(source)) {
        requireInputsKept();
    }

    Json write() const {
        Json json = base();
        json["metersPerUnit"] = scene_.metersPerUnit;
        json["exposure"] = shortNumber(scene_.exposure);
        Json& models = json["models"];
        const std::vector<std::size_t> owners = ownersOf(models);
        for (std::size_t entry = 0; entry < models.size(); ++entry) {
            setMaterials(models[entry], static_cast<std::uint32_t>(owners[entry]));
        }
        json["lights"] = Json::array();
        for (const Light& light : scene_.lights) {
            json["lights"].push_back(writeLight(light));
        }
        json["cameras"] = Json::array();
        for (const Camera& camera : scene_.cameras) {
            json["cameras"].push_back(cameraJson(camera));
        }
        json["environment"] = environment();
        return json;
    }

private:
    /// Throws SceneError where the scene is made of the target. The scene file itself may be replaced.
    void requireInputsKept() const {
        std::vector<fs::path> inputs(scene_.inputs.begin(), scene_.inputs.end());
        inputs.emplace_back(sourceIsScene_ ? fs::path() : source_);
        inputs.emplace_back(scene_.environment.file);
        for (const fs::path& input : inputs) {
            std::error_code error;
            if (fs::equivalent(input, target_, error)) {
                throw SceneError(target_.string() + ": cannot be written: the scene is made of this file");
            }
        }
    }

    /// The file that is there already, with its paths as seen from the new one; of a model a file with it alone.
    Json base() const {
        if (source_.empty()) {
            return {{"name", scene_.name}, {"models", {{{"model", "gallery"}}}}};
        }
        if (!sourceIsScene_) {
            const glm::vec3 back(-scene_.origin);
            Json model{{"model", relative(source_)}};
            if (back != glm::vec3(0)) {
                model["translate"] = shortTriple(back);
            }
            return {{"models", Json::array({model})}};
        }
        Json json = parseSceneJson(source_.string(), readFile(source_));
        json.erase("$schema"); // which is relative to the file
        Json noSurfaces = Json::object();
        for (Json& model : json["models"]) {
            rebase(model, "model", "gallery");
            for (const LookTexture& texture : lookTextures) {
                if (model.contains("surface")) {
                    rebase(model["surface"], texture.key, "");
                }
                for (Json& surface : model.contains("surfaces") ? model["surfaces"] : noSurfaces) {
                    rebase(surface, texture.key, "");
                }
            }
        }
        return json;
    }

    /// A path that is seen from the new file as `path` is from here.
    std::string relative(const fs::path& path) const {
        const fs::path folder = fs::absolute(target_).parent_path();
        const fs::path result = fs::weakly_canonical(path).lexically_relative(fs::weakly_canonical(folder));
        if (result.empty() || *result.begin() == "..") {
            throw SceneError(target_.string() + ": cannot be written: a scene file has to be in the folder of " +
                             path.string() + ", or above it");
        }
        return result.generic_string();
    }

    void rebase(Json& object, const char* key, const std::string& except) const {
        if (object.contains(key) && object[key] != except) {
            object[key] = relative(source_.parent_path() / object[key].get<std::string>());
        }
    }

    /// For each entry the first one with the same looks, whose surfaces it shares.
    static std::vector<std::size_t> ownersOf(const Json& models) {
        std::vector<std::size_t> owners;
        std::vector<Json> looks;
        for (Json model : models) {
            for (const char* place : {"translate", "rotate", "scale", "name"}) {
                model.erase(place);
            }
            owners.push_back(static_cast<std::size_t>(std::ranges::find(looks, model) - looks.begin()));
            looks.push_back(model);
        }
        return owners;
    }

    void setMaterials(Json& entry, std::uint32_t owner) const {
        std::vector<std::size_t> own;
        for (std::size_t i = 0; i < scene_.surfaces.size(); ++i) {
            if (scene_.surfaces[i].model == owner) {
                own.push_back(i);
            }
        }
        const auto materialOf = [&](std::size_t surface) {
            const std::uint32_t material = scene_.surfaces[surface].material;
            return material == none ? Json() : materialJson(scene_.materials[material]);
        };
        const bool allAlike =
            std::ranges::all_of(own, [&](std::size_t i) { return materialOf(i) == materialOf(own.front()); });
        entry.erase("material");
        entry.erase("materials");
        if (allAlike && !own.empty()) {
            entry["material"] = materialOf(own.front());
        }
        const Json given = entry.value("surface", Json::object());
        const Json before = entry.value("surfaces", Json::object());
        entry.erase("surfaces");
        for (const std::size_t i : own) {
            const std::string& name = scene_.surfaces[i].name;
            if (!allAlike) {
                setNamed(entry["materials"], name, materialOf(i));
            }
            setNamed(entry["surfaces"], name, lookToWrite(i, given, before.value(name, Json::object())));
        }
        dropEmpty(entry, "surfaces");
    }

    /// Looks that say nothing.
    static void dropEmpty(Json& entry, const char* key) {
        Json& named = entry[key];
        for (auto each = named.begin(); each != named.end();) {
            each = each->empty() ? named.erase(each) : std::next(each);
        }
        if (named.empty()) {
            entry.erase(key);
        }
    }

    /// The look that the surface's name gets: what it had before, and what a reader would not find otherwise.
    Json lookToWrite(std::size_t index, const Json& given, Json look) const {
        const Surface& surface = scene_.surfaces[index];
        const Json wanted = lookJson(surface);
        if (surface.material == none) {
            if (read_[index].material != none || wanted != lookJson(read_[index])) {
                look.update(wanted);
            }
            return look;
        }
        for (const auto& [key, value] : wanted.items()) {
            look.erase(key);
        }
        if (wanted != lookByMaterial(index, given)) {
            look.update(wanted);
        }
        return look;
    }

    /// What a reader makes of the surface by its material and the looks of its model.
    Json lookByMaterial(std::size_t index, const Json& given) const {
        const Surface& surface = scene_.surfaces[index];
        Scene model;
        model.materials = {scene_.materials[surface.material]};
        Surface fresh = read_[index];
        setSurfaceMaterial(model, fresh, 0);
        Json look = lookJson(fresh);
        for (const auto& [key, value] : given.items()) {
            if (look.contains(key)) {
                look[key] = value;
            }
        }
        return look;
    }

    void setNamed(Json& named, const std::string& name, Json value) const {
        if (named.contains(name) && named[name] != value) {
            throw SceneError(target_.string() + ": cannot be written: the model has several surfaces called " +
                             inQuotes(name) +
                             " that are not alike, and a scene file tells surfaces apart by their names");
        }
        named[name] = std::move(value);
    }

    Json environment() const {
        const Environment& environment = scene_.environment;
        Json json{{"intensity", shortNumber(environment.intensity)},
                  {"rotation", degreesOf(environment.rotation)},
                  {"zenith", shortTriple(environment.zenith)},
                  {"horizon", shortTriple(environment.horizon)},
                  {"ground", shortTriple(environment.ground)}};
        if (!environment.file.empty()) {
            json["image"] = relative(environment.file);
        }
        return json;
    }

    const Scene& scene_;
    const std::vector<Surface>& read_;
    const fs::path& source_;
    const fs::path& target_;
    bool sourceIsScene_;
};

bool isUtf8(const std::string& text) {
    try {
        static_cast<void>(Json(text).dump());
    } catch (const Json::exception&) {
        return false;
    }
    return true;
}

/// The first text that is not UTF-8, with its field; empty where all are.
std::string findOtherText(const Json& json, const std::string& field) {
    if (json.is_string()) {
        const std::string text = json.get<std::string>();
        return isUtf8(text) ? "" : field + " is " + inQuotes(text);
    }
    if (!json.is_structured()) {
        return "";
    }
    for (const auto& [key, value] : json.items()) {
        if (json.is_object() && !isUtf8(key)) {
            return field + " has the key " + inQuotes(key);
        }
        const std::string member = json.is_array() ? field + '[' + key + ']' : field + (field.empty() ? "" : ".") + key;
        if (std::string found = findOtherText(value, member); !found.empty()) {
            return found;
        }
    }
    return "";
}

/// Files and what a model has are named in any bytes, a scene file is UTF-8.
std::string formatScene(const Json& json, const fs::path& target) {
    if (const std::string found = findOtherText(json, ""); !found.empty()) {
        throw SceneError(target.string() + ": cannot be written: " + withoutMiddle(found) + ", which is not UTF-8");
    }
    return json.dump(4) + "\n";
}

} // namespace

void saveSceneFile(const Scene& scene, const std::vector<Surface>& read, const std::filesystem::path& source,
                   const std::filesystem::path& target) {
    const std::string text = formatScene(SceneFileWriter(scene, read, source, target).write(), target);
    writeFileAtomically(target, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

} // namespace nacre::scene
