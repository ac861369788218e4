#include "scene/default_view.hpp"

#include "scene/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::scene {
namespace {

/// Largest distance of a point of the outline from `center`.
float reach(const Scene& scene, const glm::vec3& center) {
    const Outline outline(scene);
    float result = 0;
    for (const Instance& instance : scene.instances) {
        for (const glm::vec3& point : outline.of(instance.mesh)) {
            result = std::max(result, glm::distance(placed(instance, point), center));
        }
    }
    return result;
}

Camera fittedCamera(const Scene& scene) {
    const glm::vec3 center = bounds(scene).center();
    const float radius = std::max(reach(scene, center), 1e-6f * std::max(1.0f, glm::length(center)));
    Camera camera;
    camera.name = "fitted";
    camera.target = center;
    constexpr float margin = 1.03f;
    const float distance = margin * radius / std::sin(camera.verticalFieldOfView / 2);
    camera.position = center + distance * glm::normalize(glm::vec3(0.35f, 0.25f, 1.0f));
    return camera;
}

/// A directional light from `from` in the camera's frame: right, up, towards the camera.
Light lightFrom(const Camera& camera, const char* name, const glm::vec3& from, const glm::vec3& color,
                float intensity) {
    const glm::vec3 back = glm::normalize(camera.position - camera.target);
    glm::vec3 right = glm::cross(camera.up, back);
    right = glm::length(right) > 0 ? glm::normalize(right) : glm::vec3(1, 0, 0);
    const glm::vec3 up = glm::cross(back, right);
    Light light;
    light.name = name;
    light.color = color;
    light.intensity = intensity;
    light.direction = -glm::normalize(right * from.x + up * from.y + back * from.z);
    return light;
}

void addLights(Scene& scene) {
    const Camera& camera = scene.cameras.front();
    scene.lights.push_back(lightFrom(camera, "key", {-0.7f, 0.7f, 0.8f}, {1.0f, 0.96f, 0.9f}, 2.6f));
    scene.lights.push_back(lightFrom(camera, "fill", {1.0f, 0.1f, 0.7f}, {0.85f, 0.92f, 1.0f}, 0.6f));
    scene.lights.push_back(lightFrom(camera, "back", {0.5f, 0.5f, -1.0f}, {1.0f, 0.98f, 0.95f}, 3.0f));
}

/// Irradiance that the lights bring to a surface in the middle of the scene that faces them all.
float irradianceInTheMiddle(const Scene& scene) {
    const glm::vec3 center = bounds(scene).center();
    float sum = 0;
    for (const Light& light : scene.lights) {
        const float metres = glm::distance(light.position, center) * static_cast<float>(scene.metersPerUnit);
        const float falloff = light.kind == LightKind::Directional ? 1.0f : 1.0f / std::max(metres * metres, 1e-4f);
        sum += std::max({light.color.x, light.color.y, light.color.z}) * light.intensity * falloff;
    }
    return sum;
}

} // namespace

void addMissingViewAndLights(Scene& scene) {
    if (scene.cameras.empty()) {
        scene.cameras.push_back(fittedCamera(scene));
    }
    if (scene.lights.empty()) {
        addLights(scene);
    }
}

std::vector<Light> builtInLights(const Scene& scene) {
    Scene bare;
    bare.cameras = scene.cameras;
    addMissingViewAndLights(bare);
    return bare.lights;
}

bool isInFront(const Light& light, const Camera& camera, const glm::vec3& center) {
    const glm::vec3 travel = light.kind == LightKind::Directional ? light.direction : center - light.position;
    return glm::dot(travel, camera.target - camera.position) >= 0;
}

void fitLights(Scene& scene) {
    const float irradiance = irradianceInTheMiddle(scene);
    constexpr float white = std::numbers::pi_v<float>; // makes a white surface's radiance 1
    constexpr float tolerated = 4;
    if (std::isfinite(irradiance) && irradiance > 0 &&
        (irradiance > white * tolerated || irradiance < white / tolerated)) {
        for (Light& light : scene.lights) {
            light.intensity *= white / irradiance;
        }
    }
}

} // namespace nacre::scene
