#include "nacre/files.hpp"

#include <nlohmann/json.hpp>

#include <set>

namespace nacre {
namespace {

// Keys keep the order of the format in the file.
using Json = nlohmann::ordered_json;

constexpr std::uint64_t maxMaterialFileBytes = std::uint64_t{1} << 20;

constexpr std::pair<AlbedoUse, const char*> albedoUseNames[] = {{AlbedoUse::Post, "post"},
                                                                {AlbedoUse::PreAndPost, "preAndPost"}};

// The library's messages start with "[json.exception.parse_error.101] ".
std::string withoutPrefix(std::string_view message) {
    const auto end = message.starts_with('[') ? message.find("] ") : std::string_view::npos;
    return std::string(end == std::string_view::npos ? message : message.substr(end + 2));
}

// Material files have three levels; unbounded ones would exhaust the stack.
constexpr int maxDepth = 16;

// Text that is JSON and gives no key twice.
Json parseJson(std::string_view text) {
    std::vector<std::set<std::string>> keys;
    const auto check = [&](int depth, Json::parse_event_t event, const Json& parsed) {
        if (depth > maxDepth) {
            throw FileError("is nested deeper than " + std::to_string(maxDepth) + " levels");
        }
        if (event == Json::parse_event_t::object_start) {
            keys.emplace_back();
        } else if (event == Json::parse_event_t::object_end) {
            keys.pop_back();
        } else if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second) {
            throw FileError("the key \"" + parsed.get<std::string>() + "\" is given twice");
        }
        return true;
    };
    try {
        return Json::parse(text, check);
    } catch (const Json::exception& error) {
        throw FileError(withoutPrefix(error.what()));
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
            throw FileError("the key \"" + name + "\" is unknown");
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

void read(const Json& value, const std::string& field, std::vector<Layer>& result) {
    if (!value.is_array() || value.empty() || value.size() > maxLayers) {
        const std::string length =
            value.is_array() ? "has " + std::to_string(value.size()) + " entries" : "is no array";
        throw FileError(field + " " + length + ", must have 1 to " + std::to_string(maxLayers));
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
        read(value[i], field + "[" + std::to_string(i) + "]", result.emplace_back());
    }
}

// Every member of a material that has a key, in the order of the file.
template <typename AnyMaterial, typename Visit> void visitMembers(AnyMaterial& material, Visit visit) {
    visit("name", material.name);
    visit("description", material.description);
    visit("layers", material.layers);
    visit("meanFreePath", material.meanFreePath);
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
Json format(const std::vector<Layer>& layers) {
    Json result;
    for (const Layer& layer : layers) {
        result.push_back({{"weight", layer.weight}, {"variance", layer.variance}});
    }
    return result;
}

Material readMaterial(const Json& json) {
    Material material;
    readObject(json, "", [&](const std::string& key, const std::string& name, const Json& value) {
        bool known = key == "$schema";
        visitMembers(material, [&](const char* member, auto& result) {
            if (key == member) {
                read(value, name, result);
                known = true;
            }
        });
        return known;
    });
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
    Json json;
    visitMembers(material, [&](const char* key, const auto& value) {
        if (Json member = format(value); !member.is_null()) {
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
