#include "view/model/edited_file.hpp"

#include "core/files/json_fault.hpp"
#include "scene/files/scene_file_light.hpp"

namespace nacre::view {
namespace {

using nlohmann::json;

json materialJson(const EditedMaterial& edited) {
    json hidden = json::array();
    for (const std::size_t layer : edited.hidden) {
        hidden.push_back(layer);
    }
    return {{"material", json::parse(formatMaterial(edited.material))}, {"hidden", hidden}};
}

EditedMaterial readMaterial(const json& value, const std::string& source) {
    EditedMaterial result{parseMaterial(value.at("material").dump(), source), {}};
    for (const json& layer : value.at("hidden")) {
        result.hidden.insert(layer.get<std::size_t>());
    }
    return result;
}

json surfaceJson(const scene::Surface& surface) {
    return {{"baseColor", scene::shortTriple(glm::vec3(surface.baseColor))},
            {"metallic", scene::shortNumber(surface.metallic)},
            {"roughness", scene::shortNumber(surface.roughness)},
            {"specular", scene::shortNumber(surface.specular)},
            {"material", surface.material == scene::none ? json() : json(surface.material)}};
}

void readSurface(const json& value, std::size_t materials, scene::Surface& surface) {
    const json& color = value.at("baseColor");
    surface.baseColor =
        glm::vec4(color.at(0).get<float>(), color.at(1).get<float>(), color.at(2).get<float>(), surface.baseColor.w);
    surface.metallic = value.at("metallic").get<float>();
    surface.roughness = value.at("roughness").get<float>();
    surface.specular = value.at("specular").get<float>();
    const json& material = value.at("material");
    surface.material = material.is_null() ? scene::none : material.get<std::uint32_t>();
    if (surface.material != scene::none && surface.material >= materials) {
        throw FileError("there is no material " + material.dump());
    }
}

/// Its file, which is the same one from every folder. What is not UTF-8 in the name is replaced.
std::string surroundingsOf(const EditedScene& edited) {
    const std::filesystem::path file = edited.environmentFile;
    const json name = file.empty() ? std::string() : std::filesystem::absolute(file).string();
    return json::parse(name.dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

EditedScene read(const json& root, const std::string& source, const EditedScene& base) {
    EditedScene result = base;
    if (root.at("materials").size() != base.materials.size() || root.at("surfaces").size() != base.surfaces.size()) {
        throw FileError("the scene has other materials or surfaces by now");
    }
    for (std::size_t i = 0; i < result.materials.size(); ++i) {
        result.materials[i] = readMaterial(root["materials"][i], source);
    }
    for (std::size_t i = 0; i < result.surfaces.size(); ++i) {
        readSurface(root["surfaces"][i], result.materials.size(), result.surfaces[i]);
    }
    result.lights.clear();
    for (const json& light : root.at("lights")) {
        scene::SceneFileObject object(light, source, "lights");
        result.lights.push_back(scene::readLight(object));
    }
    result.environmentIntensity = root.at("environmentIntensity").get<float>();
    result.environmentRotation = root.at("environmentRotation").get<float>();
    result.exposureStops = root.at("exposureStops").get<float>();
    if (const std::string file = root.at("environmentFile").get<std::string>(); file != surroundingsOf(base)) {
        setEnvironment(result, file);
    }
    return result;
}

} // namespace

std::string formatEdited(const EditedScene& edited) {
    json root{{"environmentIntensity", scene::shortNumber(edited.environmentIntensity)},
              {"environmentRotation", scene::shortNumber(edited.environmentRotation)},
              {"environmentFile", surroundingsOf(edited)},
              {"exposureStops", scene::shortNumber(edited.exposureStops)},
              {"materials", json::array()},
              {"surfaces", json::array()},
              {"lights", json::array()}};
    for (const EditedMaterial& material : edited.materials) {
        root["materials"].push_back(materialJson(material));
    }
    for (const scene::Surface& surface : edited.surfaces) {
        root["surfaces"].push_back(surfaceJson(surface));
    }
    for (const scene::Light& light : edited.lights) {
        root["lights"].push_back(scene::writeLight(light));
    }
    // Names that a model gives are in any bytes.
    return root.dump(1, ' ', false, json::error_handler_t::replace);
}

EditedScene parseEdited(std::string_view text, const std::string& source, const EditedScene& base) {
    try {
        return read(json::parse(text), source, base);
    } catch (const json::exception& error) {
        throw FileError(source + ": is not a recovery file: " + jsonFault(error.what()));
    } catch (const FileError& error) {
        throw FileError(source + ": " + error.what());
    }
}

} // namespace nacre::view
