#include "scene/gltf/gltf_object.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nacre::scene {
namespace {

std::string format(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.6g", value);
    return text;
}

} // namespace

double checkRange(const GltfFile& file, double value, double low, double high, const std::string& field) {
    constexpr double rounding = 1e-3; // what exporters are off by
    if (!(value >= low - rounding && value <= high + rounding)) {
        failGltf(file, field + " is " + format(value) + ", must be " + format(low) + " to " + format(high));
    }
    return std::clamp(value, low, high);
}

glm::vec3 vectorOf(const GltfFile& file, const std::vector<double>& values, const glm::vec3& fallback,
                   const std::string& field) {
    if (values.empty()) {
        return fallback;
    }
    if (values.size() != 3) {
        failGltf(file, field + " must be an array of 3 numbers");
    }
    return {values[0], values[1], values[2]};
}

GltfObject::GltfObject(const GltfFile& file, const tinygltf::Value& value, std::string field)
    : file_(&file), field_(std::move(field)) {
    if (value.IsObject()) {
        value_ = &value;
    }
}

GltfObject::GltfObject(const GltfFile& file, const tinygltf::ExtensionMap& extensions, const std::string& name,
                       const std::string& owner)
    : file_(&file), field_(owner + ".extensions." + name) {
    const auto found = extensions.find(name);
    if (found != extensions.end() && found->second.IsObject()) {
        value_ = &found->second;
    }
}

const tinygltf::Value* GltfObject::find(const char* key) const {
    return has(key) ? &value_->Get(key) : nullptr;
}

double GltfObject::number(const char* key, double fallback, double low, double high) const {
    const tinygltf::Value* value = find(key);
    if (value == nullptr) {
        return fallback;
    }
    if (!value->IsNumber()) {
        failGltf(*file_, fieldOf(key) + " must be a number");
    }
    return checkRange(*file_, value->GetNumberAsDouble(), low, high, fieldOf(key));
}

int GltfObject::index(const char* key) const {
    const tinygltf::Value* value = find(key);
    if (value == nullptr) {
        return -1;
    }
    if (!value->IsInt() || value->GetNumberAsInt() < 0) {
        failGltf(*file_, fieldOf(key) + " must be a whole number, 0 or more");
    }
    return value->GetNumberAsInt();
}

bool GltfObject::boolean(const char* key, bool fallback) const {
    const tinygltf::Value* value = find(key);
    if (value == nullptr) {
        return fallback;
    }
    if (!value->IsBool()) {
        failGltf(*file_, fieldOf(key) + " must be true or false");
    }
    return value->Get<bool>();
}

std::string GltfObject::text(const char* key) const {
    const tinygltf::Value* value = find(key);
    return value != nullptr && value->IsString() ? value->Get<std::string>() : std::string();
}

std::vector<double> GltfObject::numbers(const char* key, std::vector<double> fallback, double low, double high) const {
    const tinygltf::Value* value = find(key);
    if (value == nullptr) {
        return fallback;
    }
    if (!value->IsArray() || value->ArrayLen() != fallback.size()) {
        failGltf(*file_, fieldOf(key) + " must be an array of " + std::to_string(fallback.size()) + " numbers");
    }
    for (std::size_t i = 0; i < fallback.size(); ++i) {
        const std::string element = fieldOf(key) + "[" + std::to_string(i) + "]";
        const tinygltf::Value& number = value->Get(static_cast<int>(i));
        if (!number.IsNumber()) {
            failGltf(*file_, element + " must be a number");
        }
        fallback[i] = checkRange(*file_, number.GetNumberAsDouble(), low, high, element);
    }
    return fallback;
}

glm::vec3 GltfObject::color(const char* key, const glm::vec3& fallback) const {
    const auto rgb = numbers(key, {fallback.x, fallback.y, fallback.z}, 0, 1);
    return {rgb[0], rgb[1], rgb[2]};
}

GltfObject GltfObject::object(const char* key) const {
    static const tinygltf::Value missing;
    const tinygltf::Value* value = find(key);
    return {*file_, value != nullptr ? *value : missing, fieldOf(key)};
}

GltfTextureUse GltfObject::texture(const char* key) const {
    GltfTextureUse use;
    const GltfObject reference = object(key);
    if (reference.exists()) {
        use.texture = reference.index("index");
        use.texCoord = std::max(reference.index("texCoord"), 0);
        use.field = fieldOf(key);
        readTextureTransform(reference.object("extensions").object("KHR_texture_transform"), use);
    }
    return use;
}

void readTextureTransform(const GltfObject& extension, GltfTextureUse& use) {
    constexpr double limit = 1e6;
    if (!extension.exists()) {
        return;
    }
    const auto offset = extension.numbers("offset", {0, 0}, -limit, limit);
    const auto scale = extension.numbers("scale", {1, 1}, -limit, limit);
    const double rotation = extension.number("rotation", 0, -limit, limit);
    if (extension.has("texCoord")) {
        use.texCoord = extension.index("texCoord");
    }
    const double c = std::cos(rotation);
    const double s = std::sin(rotation);
    use.transform = glm::mat3(glm::vec3(c * scale[0], -s * scale[0], 0), glm::vec3(s * scale[1], c * scale[1], 0),
                              glm::vec3(offset[0], offset[1], 1));
}

} // namespace nacre::scene
