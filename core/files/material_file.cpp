#include "nacre/files.hpp"

#include "core/files/json_fault.hpp"
#include "core/files/json_structure.hpp"
#include "core/files/open_pbr.hpp"
#include "nacre/layering.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace nacre {
namespace {

// Keys keep the order of the format in the file.
using Json = nlohmann::ordered_json;

constexpr std::uint64_t maxMaterialFileBytes = std::uint64_t{1} << 20;

constexpr std::pair<AlbedoUse, const char*> albedoUseNames[] = {{AlbedoUse::Post, "post"},
                                                                {AlbedoUse::PreAndPost, "preAndPost"}};

constexpr std::pair<const char*, double SkinContent::*> skinShares[] = {{"melanin", &SkinContent::melanin},
                                                                        {"eumelanin", &SkinContent::eumelanin},
                                                                        {"haemoglobin", &SkinContent::haemoglobin},
                                                                        {"oxygenation", &SkinContent::oxygenation},
                                                                        {"water", &SkinContent::water}};

constexpr const char* infiniteThickness = "infinite";

// Material files have three levels; unbounded ones would exhaust the stack.
constexpr int maxDepth = 16;

// Text that is JSON and gives no key twice.
Json parseJson(std::string_view text) {
    JsonStructure<Json> structure(
        maxDepth, [] { throw FileError("is nested deeper than " + std::to_string(maxDepth) + " levels"); },
        [](const std::string& key) { throw FileError("the key \"" + withoutMiddle(key) + "\" is given twice"); });
    try {
        Json::sax_parse(text, &structure);
        return Json::parse(text);
    } catch (const Json::exception& error) {
        throw FileError(jsonFault(error.what()));
    }
}

[[noreturn]] void refuse(const std::string& field, const Json& value, const char* expected) {
    std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > 60) {
        text = text.substr(0, 57) + "...";
    }
    throw FileError(field + " is " + text + ", must be " + expected);
}

void read(const Json& value, const std::string& field, double& result) {
    if (!value.is_number()) {
        refuse(field, value, "a number");
    }
    result = value.get<double>();
}

void read(const Json& value, const std::string& field, std::optional<bool>& result) {
    if (!value.is_boolean()) {
        refuse(field, value, "true or false");
    }
    result = value.get<bool>();
}

void read(const Json& value, const std::string& field, std::string& result) {
    if (!value.is_string()) {
        refuse(field, value, "a string");
    }
    result = value.get<std::string>();
}

void read(const Json& value, const std::string& field, Rgb& result) {
    if (!value.is_array() || value.size() != 3) {
        refuse(field, value, "three numbers: red, green, blue");
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
        read(value[channel], field + "[" + std::to_string(channel) + "]", result[channel]);
    }
}

void read(const Json& value, const std::string& field, AlbedoUse& result) {
    for (const auto& [use, name] : albedoUseNames) {
        if (value == name) {
            result = use;
            return;
        }
    }
    refuse(field, value, "\"post\" or \"preAndPost\"");
}

void read(const Json& value, const std::string& field, bool& result) {
    if (!value.is_boolean()) {
        refuse(field, value, "true or false");
    }
    result = value.get<bool>();
}

void read(const Json& value, const std::string& field, std::optional<Rgb>& result) {
    read(value, field, result.emplace());
}

// Calls visit(key, value) on every member of an object; visit returns whether it knows the key.
template <typename Visit> void readObject(const Json& object, const std::string& field, Visit visit) {
    if (!object.is_object()) {
        refuse(field.empty() ? "the material" : field, object, "an object");
    }
    for (const auto& [key, value] : object.items()) {
        const std::string name = field.empty() ? key : field + "." + key;
        if (!visit(key, name, value)) {
            throw FileError("the key \"" + withoutMiddle(name) + "\" is unknown");
        }
    }
}

void read(const Json& value, const std::string& field, Layer& result) {
    bool hasWeight = false;
    bool hasVariance = false;
    readObject(value, field, [&](const std::string& key, const std::string& name, const Json& member) {
        if (key == "weight") {
            read(member, name, result.weight);
            return hasWeight = true;
        }
        if (key == "variance") {
            read(member, name, result.variance);
            return hasVariance = true;
        }
        return false;
    });
    if (!hasWeight || !hasVariance) {
        throw FileError(field + (hasWeight ? ".variance" : ".weight") + " is missing");
    }
}

void read(const Json& value, const std::string& field, Slab& result);

// An array of as many objects as a material may have layers.
template <typename Item> void readArray(const Json& value, const std::string& field, std::vector<Item>& result) {
    if (!value.is_array() || value.empty() || value.size() > maxLayers) {
        const std::string length =
            value.is_array() ? "has " + std::to_string(value.size()) + " entries" : "is no array";
        throw FileError(field + " " + length + ", must have 1 to " + std::to_string(maxLayers));
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
        read(value[i], field + "[" + std::to_string(i) + "]", result.emplace_back());
    }
}

void read(const Json& value, const std::string& field, std::vector<Layer>& result) {
    readArray(value, field, result);
}

void read(const Json& value, const std::string& field, SkinContent& result) {
    readObject(value, field, [&](const std::string& key, const std::string& name, const Json& member) {
        for (const auto& [known, share] : skinShares) {
            if (key == known) {
                read(member, name, result.*share);
                return true;
            }
        }
        return false;
    });
}

// A length, or the word for a slab without a lower face.
void readThickness(const Json& value, const std::string& field, double& result) {
    if (value == infiniteThickness) {
        result = std::numeric_limits<double>::infinity();
    } else if (value.is_number()) {
        result = value.get<double>();
    } else {
        refuse(field, value, "a number of mm or \"infinite\"");
    }
}

// The members of a slab as a file has them.
struct SlabMembers {
    std::optional<Rgb> absorption;
    std::optional<Rgb> reducedScattering;
    std::optional<Rgb> scattering;
    std::optional<Rgb> anisotropy;
    std::optional<double> refractiveIndex;
    std::optional<double> thickness;
    std::optional<SkinContent> skin;
};

SlabMembers readMembers(const Json& value, const std::string& field) {
    SlabMembers slab;
    readObject(value, field, [&](const std::string& key, const std::string& name, const Json& member) {
        for (const auto& [known, coefficient] :
             {std::pair("absorption", &slab.absorption), std::pair("reducedScattering", &slab.reducedScattering),
              std::pair("scattering", &slab.scattering), std::pair("anisotropy", &slab.anisotropy)}) {
            if (key == known) {
                read(member, name, *coefficient);
                return true;
            }
        }
        if (key == "refractiveIndex") {
            read(member, name, slab.refractiveIndex.emplace());
        } else if (key == "thickness") {
            readThickness(member, name, slab.thickness.emplace());
        } else if (key == "skin") {
            read(member, name, slab.skin.emplace());
        }
        return key == "refractiveIndex" || key == "thickness" || key == "skin";
    });
    return slab;
}

// Throws where members that belong together are not all there, or say the same twice.
void checkMembers(const SlabMembers& slab, const std::string& field) {
    if (!slab.thickness) {
        throw FileError(field + ".thickness is missing");
    }
    if (slab.skin && slab.absorption) {
        throw FileError(field + ".skin and " + field +
                        ".absorption are both given, only one may describe what absorbs");
    }
    if (!slab.skin && !slab.absorption) {
        throw FileError(field + ".absorption is missing, and there is no skin in its place");
    }
    if (slab.scattering && slab.reducedScattering) {
        throw FileError(field + ".scattering and " + field + ".reducedScattering are both given, only one may");
    }
    if (slab.scattering && !slab.anisotropy) {
        throw FileError(field + ".anisotropy is missing, which scattering needs");
    }
    if (!slab.skin && !slab.scattering && !slab.reducedScattering) {
        throw FileError(field + ".reducedScattering is missing, and there is no scattering in its place");
    }
}

void read(const Json& value, const std::string& field, Slab& result) {
    const SlabMembers slab = readMembers(value, field);
    checkMembers(slab, field);
    if (slab.skin) {
        if (const std::string fault = findFault(*slab.skin); !fault.empty()) {
            throw FileError(field + ".skin." + fault);
        }
        result = makeSkinSlab(*slab.skin, *slab.thickness);
    }
    Medium& medium = result.medium;
    result.thickness = *slab.thickness;
    medium.absorption = slab.absorption.value_or(medium.absorption);
    medium.anisotropy = slab.anisotropy.value_or(medium.anisotropy);
    medium.reducedScattering = slab.reducedScattering.value_or(medium.reducedScattering);
    medium.refractiveIndex = slab.refractiveIndex.value_or(tissueRefractiveIndex);
    for (std::size_t channel = 0; slab.scattering && channel < 3; ++channel) {
        medium.reducedScattering[channel] = (*slab.scattering)[channel] * (1 - medium.anisotropy[channel]);
    }
}

void read(const Json& value, const std::string& field, std::vector<Slab>& result) {
    readArray(value, field, result);
}

// Every member of a material that has a key, in the order of the file.
template <typename AnyMaterial, typename Visit> void visitMembers(AnyMaterial& material, Visit visit) {
    visit("name", material.name);
    visit("description", material.description);
    visit("layers", material.layers);
    visit("meanFreePath", material.meanFreePath);
    visit("slabs", material.slabs);
    visit("albedoUse", material.albedoUse);
    visit("strength", material.strength);
    visit("translucency", material.translucency);
    visit("diffuseTransmission", material.diffuseTransmission);
    visit("diffuseTransmissionColor", material.diffuseTransmissionColor);
    visit("scale", material.scale);
    visit("secondSurfaces", material.secondSurfaces);
    visit("albedo", material.albedo);
    visit("roughness", material.roughness);
    visit("specular", material.specular);
    visit("secondLobe", material.secondLobe);
    visit("secondLobeRoughness", material.secondLobeRoughness);
}

// OpenPBR's names, which a file may use in place of those above.
template <typename Visit> void visitOpenPbr(OpenPbr& surface, Visit visit) {
    visit("base_color", surface.baseColor);
    visit("subsurface_weight", surface.subsurfaceWeight);
    visit("subsurface_color", surface.subsurfaceColor);
    visit("subsurface_radius", surface.subsurfaceRadius);
    visit("subsurface_radius_scale", surface.subsurfaceRadiusScale);
    visit("subsurface_scatter_anisotropy", surface.subsurfaceAnisotropy);
    visit("specular_weight", surface.specularWeight);
    visit("specular_roughness", surface.specularRoughness);
    visit("specular_ior", surface.specularIor);
    visit("geometry_thin_walled", surface.thinWalled);
}

Json format(AlbedoUse use) {
    return albedoUseNames[static_cast<std::size_t>(use)].second;
}
template <typename Value> Json format(const std::optional<Value>& value) {
    return value ? Json(*value) : Json();
}
template <typename Value> Json format(const Value& value) {
    return value;
}
Json format(const Slab& slab) {
    Json result;
    if (slab.skin) {
        for (const auto& [key, share] : skinShares) {
            result["skin"][key] = (*slab.skin).*share;
        }
    } else {
        result["absorption"] = slab.medium.absorption;
    }
    result["reducedScattering"] = slab.medium.reducedScattering;
    result["anisotropy"] = slab.medium.anisotropy;
    result["refractiveIndex"] = slab.medium.refractiveIndex;
    result["thickness"] = std::isinf(slab.thickness) ? Json(infiniteThickness) : Json(slab.thickness);
    return result;
}
Json format(const std::vector<Slab>& slabs) {
    Json result;
    for (const Slab& slab : slabs) {
        result.push_back(format(slab));
    }
    return result;
}
Json format(const std::vector<Layer>& layers) {
    Json result;
    for (const Layer& layer : layers) {
        result.push_back({{"weight", layer.weight}, {"variance", layer.variance}});
    }
    return result;
}

// The layers of the slabs, and what else they say unless the file says otherwise.
void addLayersOfSlabs(Material& material, const Json& json) {
    if (!material.layers.empty() || material.meanFreePath) {
        throw FileError(std::string("slabs and ") + (material.meanFreePath ? "meanFreePath" : "layers") +
                        " are both given, only one may describe the profile");
    }
    if (const std::string fault = findFault(std::span<const Slab>(material.slabs)); !fault.empty()) {
        throw FileError(fault);
    }
    Material described = material;
    describeBySlabs(described, material.slabs);
    material.layers = described.layers;
    material.albedo = json.contains("albedo") ? material.albedo : described.albedo;
    material.specular = json.contains("specular") ? material.specular : described.specular;
}

// What OpenPBR says: a profile of its own, and the members that the file does not give by their own names.
void addOpenPbr(Material& material, const OpenPbr& surface, const Json& json) {
    for (const char* other : {"layers", "meanFreePath", "slabs"}) {
        if (json.contains(other)) {
            throw FileError(std::string("subsurface_weight and ") + other +
                            " are both given, only one may describe the profile");
        }
    }
    if (const std::string fault = findFault(surface); !fault.empty()) {
        throw FileError(fault);
    }
    const Material described = materialOf(surface);
    const auto take = [&json](const char* key, auto& member, const auto& value) {
        member = json.contains(key) ? member : value;
    };
    material.meanFreePath = described.meanFreePath;
    take("strength", material.strength, described.strength);
    take("diffuseTransmission", material.diffuseTransmission, described.diffuseTransmission);
    take("albedo", material.albedo, described.albedo);
    take("roughness", material.roughness, described.roughness);
    take("specular", material.specular, described.specular);
}

Material readMaterial(const Json& json) {
    Material material;
    OpenPbr surface;
    std::string ofOpenPbr;
    readObject(json, "", [&](const std::string& key, const std::string& name, const Json& value) {
        bool known = key == "$schema";
        visitMembers(material, [&](const char* member, auto& result) {
            if (key == member) {
                read(value, name, result);
                known = true;
            }
        });
        visitOpenPbr(surface, [&](const char* member, auto& result) {
            if (key == member) {
                read(value, name, result);
                ofOpenPbr = key;
                known = true;
            }
        });
        return known;
    });
    if (!ofOpenPbr.empty() && !json.contains("subsurface_weight")) {
        throw FileError("subsurface_weight is missing, which " + ofOpenPbr + " needs");
    }
    if (!ofOpenPbr.empty()) {
        addOpenPbr(material, surface, json);
    }
    if (!material.slabs.empty()) {
        addLayersOfSlabs(material, json);
    }
    if (const std::string fault = findFault(material); !fault.empty()) {
        throw FileError(fault);
    }
    return material;
}

} // namespace

Material parseMaterial(std::string_view json, std::string_view sourceName) {
    try {
        return readMaterial(parseJson(json));
    } catch (const FileError& error) {
        throw FileError(std::string(sourceName) + ": " + error.what());
    }
}

std::string formatMaterial(const Material& material) {
    if (const std::string fault = findFault(material); !fault.empty()) {
        throw FileError(material.name + ": " + fault);
    }
    if (!material.slabs.empty() && material.layers != layersOf(material.slabs)) {
        throw FileError(material.name + ": layers are not those of slabs, and a file holds only one of them");
    }
    Json json;
    visitMembers(material, [&](const char* key, const auto& value) {
        const bool ofSlabs = std::string_view(key) == "layers" && !material.slabs.empty();
        if (Json member = format(value); !member.is_null() && !ofSlabs) {
            json[key] = std::move(member);
        }
    });
    try {
        return json.dump(4) + "\n";
    } catch (const Json::exception&) {
        throw FileError("the name or the description of a material is not UTF-8");
    }
}

Material loadMaterial(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file, maxMaterialFileBytes);
    Material material = parseMaterial({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
    if (material.name.empty()) {
        material.name = file.stem().string();
    }
    return material;
}

void saveMaterial(const Material& material, const std::filesystem::path& file) {
    const std::string text = formatMaterial(material);
    writeFileAtomically(file, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

} // namespace nacre
