#include "scene/gltf/gltf_light.hpp"

#include "scene/gltf/gltf_object.hpp"
#include "scene/gltf/gltf_pose.hpp"

#include <numbers>

namespace nacre::scene {
namespace {

constexpr const char* lightsExtension = "KHR_lights_punctual";
constexpr double brightest = 1e12;

LightKind kindOf(const GltfFile& file, const std::string& type, const std::string& field) {
    if (type == "directional") {
        return LightKind::Directional;
    }
    if (type == "spot") {
        return LightKind::Spot;
    }
    if (type != "point") {
        failGltf(file, field + ".type is \"" + type + "\", must be directional, spot or point");
    }
    return LightKind::Point;
}

glm::vec3 colorOf(const GltfFile& file, const std::vector<double>& values, const std::string& field) {
    const glm::vec3 color = vectorOf(file, values, glm::vec3(1), field);
    for (int i = 0; i < 3; ++i) {
        checkRange(file, color[i], 0, brightest, field);
    }
    return color;
}

} // namespace

std::optional<Light> readLight(const GltfFile& file, const tinygltf::Node& node, const std::string& owner,
                               const glm::mat4& transform) {
    const GltfObject reference(file, node.extensions, lightsExtension, owner);
    if (!reference.exists()) {
        return std::nullopt;
    }
    const int index = reference.index("light");
    const tinygltf::Light& source =
        elementOf(file, file.model.lights, index, owner + ".extensions." + lightsExtension + ".light");
    const std::string field = std::string("extensions.") + lightsExtension + ".lights[" + std::to_string(index) + "]";
    const auto number = [&](double value, double low, double high, const char* key) {
        return static_cast<float>(checkRange(file, value, low, high, field + key));
    };
    Light light;
    light.name = source.name.empty() ? node.name : source.name;
    light.kind = kindOf(file, source.type, field);
    light.color = colorOf(file, source.color, field + ".color");
    light.intensity = number(source.intensity, 0, brightest, ".intensity");
    light.range = number(source.range, 0, brightest, ".range");
    light.position = glm::vec3(transform[3]);
    // A scale of 0 leaves no direction; the node's own is as good as any.
    light.direction = -unitAxis(transform, 2).value_or(glm::vec3(0, 0, 1));
    light.outerConeAngle = number(source.spot.outerConeAngle, 1e-4, std::numbers::pi / 2, ".spot.outerConeAngle");
    light.innerConeAngle = number(source.spot.innerConeAngle, 0, light.outerConeAngle, ".spot.innerConeAngle");
    return light;
}

} // namespace nacre::scene
