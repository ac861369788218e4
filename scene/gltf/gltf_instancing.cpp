#include "scene/gltf/gltf_instancing.hpp"

#include "scene/import_mesh.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace nacre::scene {
namespace {

constexpr const char* instancingExtension = "EXT_mesh_gpu_instancing";

struct Attribute {
    std::vector<float> values;
    std::size_t components = 3;

    std::size_t count() const { return values.size() / components; }
    glm::vec3 vector(std::size_t i, const glm::vec3& fallback) const {
        return values.empty() ? fallback : glm::vec3(values[i * 3], values[i * 3 + 1], values[i * 3 + 2]);
    }
};

Attribute readAttribute(const GltfFile& file, const GltfObject& attributes, const char* name, std::size_t components,
                        const std::string& field) {
    const int accessor = attributes.index(name);
    if (accessor < 0) {
        return {{}, components};
    }
    return {readFloats(file, accessor, static_cast<int>(components), field + "." + name), components};
}

/// How many elements the other attributes have: instances that differ in nothing that is drawn.
std::size_t countOfCustom(const GltfFile& file, const tinygltf::Node& node, const std::string& field) {
    const tinygltf::Value& attributes = node.extensions.at(instancingExtension).Get("attributes");
    const std::vector<std::string> keys = attributes.IsObject() ? attributes.Keys() : std::vector<std::string>();
    if (keys.empty()) {
        return 0;
    }
    const tinygltf::Value& accessor = attributes.Get(keys.front());
    return elementOf(file, file.model.accessors, accessor.IsInt() ? accessor.GetNumberAsInt() : -1,
                     field + "." + keys.front())
        .count;
}

glm::quat rotationOf(const Attribute& rotations, std::size_t i) {
    if (rotations.values.empty()) {
        return {1, 0, 0, 0};
    }
    const float* v = &rotations.values[i * 4];
    const glm::quat rotation(v[3], v[0], v[1], v[2]);
    return glm::length(rotation) > 0 ? glm::normalize(rotation) : glm::quat(1, 0, 0, 0);
}

} // namespace

std::vector<glm::mat4> readInstances(const GltfFile& file, const tinygltf::Node& node, const std::string& owner) {
    const GltfObject extension(file, node.extensions, instancingExtension, owner);
    if (!extension.exists()) {
        return {glm::mat4(1)};
    }
    const std::string field = owner + ".extensions." + instancingExtension + ".attributes";
    const GltfObject attributes = extension.object("attributes");
    const Attribute translations = readAttribute(file, attributes, "TRANSLATION", 3, field);
    const Attribute rotations = readAttribute(file, attributes, "ROTATION", 4, field);
    const Attribute scales = readAttribute(file, attributes, "SCALE", 3, field);
    std::size_t count = std::max({translations.count(), rotations.count(), scales.count()});
    for (const Attribute* attribute : {&translations, &rotations, &scales}) {
        if (!attribute->values.empty() && attribute->count() != count) {
            failGltf(file, field + " have " + std::to_string(attribute->count()) + " and " + std::to_string(count) +
                               " elements, must have as many");
        }
    }
    count = count > 0 ? count : countOfCustom(file, node, field);
    if (count > maxInstances) {
        failGltf(file, "places more than " + std::to_string(maxInstances) + " meshes");
    }
    std::vector<glm::mat4> transforms;
    transforms.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::mat4 place = glm::translate(glm::mat4(1), translations.vector(i, glm::vec3(0)));
        transforms.push_back(
            glm::scale(place * glm::mat4_cast(rotationOf(rotations, i)), scales.vector(i, glm::vec3(1))));
        for (int k = 0; k < 16; ++k) {
            if (!(std::abs(transforms.back()[k / 4][k % 4]) <= maxCoordinate)) {
                failGltf(file, field + " place element " + std::to_string(i) + " beyond 1e15 or nowhere");
            }
        }
    }
    return transforms;
}

} // namespace nacre::scene
