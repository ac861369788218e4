#include "scene/files/scene_file_object.hpp"

#include "core/files/json_fault.hpp"
#include "core/files/json_structure.hpp"
#include "scene/json_text.hpp"
#include "scene/named_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace nacre::scene {
namespace {

using Json = nlohmann::json;

constexpr int maxDepth = 32;

std::string format(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.9g", value);
    return text;
}

std::string describe(const NumberRange& range) {
    const std::string low = format(range.low);
    return "a number " + (range.lowExcluded ? "above " + low + " and at most " : "from " + low + " to ") +
           format(range.high);
}

bool isInside(double value, const NumberRange& range) {
    return value <= range.high && (range.lowExcluded ? value > range.low : value >= range.low);
}

} // namespace

SceneFileObject::SceneFileObject(const Json& json, std::string file, std::string field)
    : json_(&json), file_(std::move(file)), field_(std::move(field)) {
    if (!json.is_object()) {
        throw SceneError(file_ + ": " + (field_.empty() ? "the scene" : field_) + " is " + shorten(json) +
                         ", must be an object");
    }
}

const Json* SceneFileObject::member(const char* key) {
    known_.emplace_back(key);
    const auto found = json_->find(key);
    return found != json_->end() ? &*found : nullptr;
}

bool SceneFileObject::has(const char* key) {
    return json_->contains(key);
}

void SceneFileObject::refuse(const char* key, const std::string& expected) const {
    throw SceneError(file_ + ": " + fieldOf(key) + " is " + shorten(json_->value(key, Json())) + ", must be " +
                     expected);
}

std::filesystem::path SceneFileObject::namedFile(const char* key, const std::string& reference,
                                                 const std::string& expected) const {
    const std::filesystem::path owner = file_;
    std::string slashed = reference;
    std::ranges::replace(slashed, '\\', '/');
    std::error_code ignored;
    if (reference.empty() || !std::filesystem::exists(owner.parent_path() / slashed, ignored)) {
        refuse(key, expected);
    }
    return findNamedFile(owner, reference, file_ + ": " + fieldOf(key));
}

void SceneFileObject::require(const char* key) {
    if (!has(key)) {
        throw SceneError(file_ + ": " + fieldOf(key) + " is missing");
    }
}

double SceneFileObject::number(const char* key, double fallback, const NumberRange& range) {
    const Json* value = member(key);
    if (value == nullptr) {
        return fallback;
    }
    if (!value->is_number()) {
        refuse(key, "a number");
    }
    if (!isInside(value->get<double>(), range)) {
        refuse(key, describe(range));
    }
    return value->get<double>();
}

float SceneFileObject::real(const char* key, float fallback, const NumberRange& range) {
    return static_cast<float>(number(key, fallback, range));
}

template <int size>
glm::vec<size, float> SceneFileObject::vector(const char* key, glm::vec<size, float> fallback,
                                              const NumberRange& range) {
    const Json* value = member(key);
    if (value == nullptr) {
        return fallback;
    }
    const auto isNumber = [](const Json& item) { return item.is_number(); };
    if (!value->is_array() || value->size() != size || !std::ranges::all_of(*value, isNumber)) {
        refuse(key, "an array of " + std::to_string(size) + " numbers");
    }
    for (int i = 0; i < size; ++i) {
        const double item = (*value)[static_cast<std::size_t>(i)].get<double>();
        if (!isInside(item, range)) {
            throw SceneError(file_ + ": " + fieldOf(key) + "[" + std::to_string(i) + "] is " + format(item) +
                             ", must be " + describe(range));
        }
        fallback[i] = static_cast<float>(item);
    }
    return fallback;
}

glm::vec2 SceneFileObject::pair(const char* key, const glm::vec2& fallback, const NumberRange& range) {
    return vector<2>(key, fallback, range);
}

glm::vec3 SceneFileObject::triple(const char* key, const glm::vec3& fallback, const NumberRange& range) {
    return vector<3>(key, fallback, range);
}

bool SceneFileObject::boolean(const char* key, bool fallback) {
    const Json* value = member(key);
    if (value != nullptr && !value->is_boolean()) {
        refuse(key, "true or false");
    }
    return value != nullptr ? value->get<bool>() : fallback;
}

std::string SceneFileObject::text(const char* key, const std::string& fallback) {
    const Json* value = member(key);
    if (value != nullptr && !value->is_string()) {
        refuse(key, "a string");
    }
    return value != nullptr ? value->get<std::string>() : fallback;
}

std::size_t SceneFileObject::choice(const char* key, std::size_t fallback, std::span<const char* const> choices) {
    const Json* value = member(key);
    if (value == nullptr) {
        return fallback;
    }
    const auto found = std::ranges::find_if(choices, [&](const char* name) { return *value == name; });
    if (found == choices.end()) {
        std::string expected;
        for (const char* name : choices) {
            expected += (expected.empty() ? "\"" : ", \"") + std::string(name) + "\"";
        }
        refuse(key, "one of " + expected);
    }
    return static_cast<std::size_t>(found - choices.begin());
}

SceneFileObject SceneFileObject::object(const char* key) {
    static const Json empty = Json::object();
    const Json* value = member(key);
    return {value != nullptr ? *value : empty, file_, fieldOf(key)};
}

std::vector<SceneFileObject> SceneFileObject::objects(const char* key) {
    const Json* value = member(key);
    std::vector<SceneFileObject> result;
    if (value == nullptr) {
        return result;
    }
    if (!value->is_array()) {
        refuse(key, "an array");
    }
    for (std::size_t i = 0; i < value->size(); ++i) {
        result.emplace_back((*value)[i], file_, fieldOf(key) + "[" + std::to_string(i) + "]");
    }
    return result;
}

void SceneFileObject::finish() const {
    for (const auto& [key, value] : json_->items()) {
        if (std::ranges::find(known_, key) == known_.end()) {
            std::string names;
            for (const std::string& name : known_) {
                names += (names.empty() ? "" : ", ") + name;
            }
            throw SceneError(file_ + ": the key \"" + fieldOf(key) + "\" is unknown, there are " + names);
        }
    }
}

Json parseSceneJson(const std::string& file, std::span<const std::uint8_t> bytes) {
    JsonStructure<Json> structure(
        maxDepth, [&file] { throw SceneError(file + ": is nested more than " + std::to_string(maxDepth) + " deep"); },
        [&file](const std::string& key) {
            throw SceneError(file + ": the key " + shorten(Json(key)) + " is given twice");
        });
    try {
        Json::sax_parse(bytes.begin(), bytes.end(), &structure);
        return Json::parse(bytes.begin(), bytes.end());
    } catch (const Json::exception& error) {
        throw SceneError(file + ": is not valid JSON: " + jsonFault(error.what()));
    }
}

} // namespace nacre::scene
