#include "scene/files/scene_file_light.hpp"

#include <array>
#include <charconv>

namespace nacre::scene {

namespace {

using Json = nlohmann::json;

}

Json shortNumber(float value) {
    std::array<char, 32> text{};
    const char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return Json::parse(std::string(text.data(), end - text.data()));
}

Json degreesOf(float radians) {
    return shortNumber(radians / degree);
}

Json shortTriple(const glm::vec3& value) {
    return {shortNumber(value.x), shortNumber(value.y), shortNumber(value.z)};
}

Json writeLight(const Light& light) {
    constexpr std::array kinds{"directional", "spot", "point"};
    Json json{{"name", light.name},
              {"type", kinds[static_cast<std::size_t>(light.kind)]},
              {"color", shortTriple(light.color)},
              {"intensity", shortNumber(light.intensity)},
              {"castsShadow", light.castsShadow}};
    if (light.kind != LightKind::Point) {
        json["direction"] = shortTriple(light.direction);
    }
    if (light.kind != LightKind::Directional) {
        json["position"] = shortTriple(light.position);
        json["range"] = shortNumber(light.range);
    }
    if (light.kind == LightKind::Spot) {
        json["outerConeAngle"] = degreesOf(light.outerConeAngle);
        json["innerConeAngle"] = degreesOf(light.innerConeAngle);
    }
    return json;
}

void checkDirection(const SceneFileObject& object, const char* key, const glm::vec3& direction) {
    if (!(glm::length(direction) > 0)) {
        object.refuse(key, "a direction other than (0, 0, 0)");
    }
}

Light readLight(SceneFileObject& object) {
    constexpr std::array kinds{"directional", "spot", "point"};
    Light light;
    light.name = object.text("name");
    object.require("type");
    light.kind = static_cast<LightKind>(object.choice("type", 0, kinds));
    light.color = object.triple("color", light.color, nonNegative);
    light.intensity = object.real("intensity", light.intensity, nonNegative);
    light.position = object.triple("position", light.position);
    if (light.kind != LightKind::Point) {
        object.require("direction");
    }
    if (light.kind != LightKind::Directional) {
        object.require("position");
    }
    light.direction = object.triple("direction", light.direction);
    checkDirection(object, "direction", light.direction);
    light.direction = glm::normalize(light.direction);
    light.range = object.real("range", light.range, nonNegative);
    light.outerConeAngle = object.real("outerConeAngle", 45, {0, 90, true}) * degree;
    light.innerConeAngle = object.real("innerConeAngle", 0, {0, 90}) * degree;
    if (light.innerConeAngle > light.outerConeAngle) {
        object.refuse("innerConeAngle", "at most outerConeAngle");
    }
    light.castsShadow = object.boolean("castsShadow", light.castsShadow);
    object.finish();
    return light;
}

} // namespace nacre::scene
