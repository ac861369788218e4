#include "view/model/light_handles.hpp"

#include "view/model/camera_control.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

constexpr float sphereShare = 0.42f; // of the picture's height at the target: the sphere of directional lights
constexpr float lineShare = 0.12f;   // likewise: a handle's line
constexpr float rim = 0.02f;         // of the picture, from its edge

/// The camera's lines of sight, and back.
struct Sight {
    glm::vec3 position;
    glm::vec3 target;
    CameraAxes axes;
    float height;   ///< scene units that the picture is high at the target
    float distance; ///< of the target
    float aspect;
    bool parallel;
    glm::vec2 offCenter;

    Sight(const scene::Camera& camera, float aspectRatio)
        : position(camera.position),
          target(camera.target),
          axes(axesOf(camera)),
          height(heightAtTarget(camera)),
          distance(glm::distance(camera.position, camera.target)),
          aspect(aspectRatio),
          parallel(camera.projection == scene::ProjectionKind::Orthographic),
          offCenter(camera.offCenter) {}

    float depthOf(const glm::vec3& point) const { return glm::dot(point - position, axes.forward); }
    /// Half the picture's height in scene units, at a depth.
    float halfAt(float depth) const { return 0.5f * height * (parallel ? 1 : depth / distance); }

    glm::vec2 placeOf(const glm::vec3& point) const {
        const float half = halfAt(depthOf(point));
        const glm::vec2 shift(glm::dot(point - position, axes.right) / (half * aspect),
                              glm::dot(point - position, axes.up) / half);
        return {0.5f + 0.5f * (shift.x + offCenter.x), 0.5f - 0.5f * (shift.y + offCenter.y)};
    }
    glm::vec3 pointAt(glm::vec2 place, float depth) const {
        const glm::vec2 shift(2 * place.x - 1 - offCenter.x, 1 - 2 * place.y - offCenter.y);
        const float half = halfAt(depth);
        return position + depth * axes.forward + shift.x * half * aspect * axes.right + shift.y * half * axes.up;
    }
};

std::optional<LightHandle> handleOf(const scene::Light& light, const Sight& sight) {
    const bool directional = light.kind == scene::LightKind::Directional;
    const glm::vec3 direction = light.kind == scene::LightKind::Point ? glm::vec3(0) : glm::normalize(light.direction);
    const glm::vec3 point = directional ? sight.target - sphereShare * sight.height * direction : light.position;
    const glm::vec3 end = point + lineShare * sight.height * direction;
    const float nearest = 1e-3f * sight.distance;
    if (sight.depthOf(point) <= nearest || sight.depthOf(end) <= nearest) {
        return std::nullopt;
    }
    const glm::vec2 whole = sight.placeOf(point);
    const glm::vec2 inside = glm::clamp(whole, rim, 1 - rim);
    return LightHandle{0, inside, inside + (sight.placeOf(end) - whole), sight.depthOf(point) > sight.distance};
}

/// The way from a place of the sphere around the target to the target; nothing where the line of sight misses it.
std::optional<glm::vec3> directionFrom(const Sight& sight, glm::vec2 place, bool behind) {
    const float radius = sphereShare * sight.height;
    const glm::vec3 through = sight.pointAt(place, sight.distance);
    const glm::vec3 ray = sight.parallel ? sight.axes.forward : glm::normalize(through - sight.position);
    const glm::vec3 fromTarget = through - sight.target;
    const float along = glm::dot(fromTarget, ray);
    const float under = along * along - glm::dot(fromTarget, fromTarget) + radius * radius;
    if (under < 0) {
        return std::nullopt;
    }
    const glm::vec3 point = fromTarget + (-along + (behind ? 1.0f : -1.0f) * std::sqrt(under)) * ray;
    return -glm::normalize(point);
}

} // namespace

std::vector<LightHandle> lightHandles(std::span<const scene::Light> lights, const scene::Camera& camera, float aspect) {
    const Sight sight(camera, aspect);
    std::vector<LightHandle> handles;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (std::optional<LightHandle> handle = handleOf(lights[i], sight)) {
            handle->light = i;
            handles.push_back(*handle);
        }
    }
    return handles;
}

std::optional<scene::Light> draggedLight(const scene::Light& light, const scene::Camera& camera, float aspect,
                                         glm::vec2 place, LightDrag drag, bool behind) {
    const Sight sight(camera, aspect);
    scene::Light result = light;
    if (light.kind == scene::LightKind::Directional) {
        const std::optional<glm::vec3> direction = directionFrom(sight, place, behind);
        if (!direction) {
            return std::nullopt;
        }
        result.direction = *direction;
    } else if (drag == LightDrag::Aim && light.kind == scene::LightKind::Spot) {
        const glm::vec3 direction = sight.pointAt(place, sight.distance) - light.position;
        if (glm::length(direction) > 0) {
            result.direction = glm::normalize(direction);
        }
    } else {
        result.position = sight.pointAt(place, sight.depthOf(light.position));
    }
    return result;
}

scene::Light pushedLight(const scene::Light& light, const scene::Camera& camera, float factor) {
    scene::Light result = light;
    if (light.kind != scene::LightKind::Directional) {
        result.position = camera.position + factor * (light.position - camera.position);
    }
    return result;
}

scene::Light newLight(scene::LightKind kind, const scene::Camera& camera, double metersPerUnit) {
    constexpr glm::vec3 besideTarget{0.3f, 0.32f, -0.6f}; // picture heights, right, up and forward
    constexpr float irradiance = 8;                       // where the camera looks
    const Sight sight(camera, 1);
    scene::Light light;
    light.kind = kind;
    light.position = sight.target + sight.height * (besideTarget.x * sight.axes.right + besideTarget.y * sight.axes.up +
                                                    besideTarget.z * sight.axes.forward);
    light.direction = glm::normalize(sight.target - light.position);
    light.outerConeAngle = 0.4f;
    light.innerConeAngle = 0.3f;
    light.intensity = irradiance;
    if (kind != scene::LightKind::Directional) {
        const float metres = glm::distance(light.position, sight.target) * static_cast<float>(metersPerUnit);
        light.intensity = irradiance * metres * metres;
    }
    return light;
}

} // namespace nacre::view
