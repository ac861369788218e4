#include "renderer/camera.hpp"

#include "renderer/graphics_device.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

namespace nacre::renderer {
namespace {

/// Near plane over far plane when the scene reaches up to the camera: fine for a reversed 32-bit float depth buffer.
constexpr float smallestNearToFar = 1e-4f;
/// Planes are moved apart by this share so that rounding cuts nothing off.
constexpr float margin = 0.01f;

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string format(float value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

void check(bool condition, const scene::Camera& camera, const std::string& fault) {
    if (!condition) {
        throw RendererError("the camera '" + camera.name + "' " + fault);
    }
}

void check(const scene::Camera& camera, float aspect) {
    check(finite(camera.position) && finite(camera.target) && finite(camera.up), camera,
          "has a position, target or up vector that is not finite");
    check(glm::distance(camera.position, camera.target) > 0, camera, "has its target where it stands");
    check(std::isfinite(aspect) && aspect > 0, camera, "makes a picture without area");
    check(std::isfinite(camera.offCenter.x) && std::isfinite(camera.offCenter.y), camera,
          "has an offCenter that is not finite");
    if (camera.projection == scene::ProjectionKind::Perspective) {
        check(camera.verticalFieldOfView > 0 && camera.verticalFieldOfView < std::numbers::pi_v<float>, camera,
              "has a verticalFieldOfView of " + format(camera.verticalFieldOfView) +
                  ", which must lie between 0 and pi");
    } else {
        check(camera.orthographicHeight > 0 && std::isfinite(camera.orthographicHeight), camera,
              "has an orthographicHeight of " + format(camera.orthographicHeight) + ", which must be above 0");
    }
}

/// What is wrong with planes of which at least one is the camera's own.
std::string describePlanes(const View& view, const scene::Camera& camera) {
    const std::string nearPlane = format(view.nearPlane);
    const std::string farPlane = format(view.farPlane);
    if (!(camera.farPlane > 0)) {
        return "has its nearPlane at " + nearPlane + ", behind the scene, which ends at " + farPlane;
    }
    if (!(camera.nearPlane > 0)) {
        return "has its farPlane at " + farPlane + ", before the scene, which begins at " + nearPlane;
    }
    return "has its nearPlane at " + nearPlane + ", which is not before its farPlane at " + farPlane;
}

void fitPlanes(View& view, const scene::Camera& camera, const scene::Bounds& bounds) {
    float nearest = std::numeric_limits<float>::max();
    float farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 point((corner & 1) ? bounds.high.x : bounds.low.x, (corner & 2) ? bounds.high.y : bounds.low.y,
                              (corner & 4) ? bounds.high.z : bounds.low.z);
        const float depth = -(view.viewFromWorld * glm::vec4(point, 1)).z;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const float extent = std::max(bounds.radius(), 1e-6f);
    view.farPlane = camera.farPlane > 0 ? camera.farPlane : std::max(farthest + margin * extent, margin * extent);
    view.nearPlane = camera.nearPlane > 0 ? camera.nearPlane
                                          : std::max(nearest - margin * extent, smallestNearToFar * view.farPlane);
    check(view.nearPlane < view.farPlane, camera, describePlanes(view, camera));
}

} // namespace

Axes axesAround(const glm::vec3& direction, const glm::vec3& preferredUp) {
    glm::vec3 right = glm::cross(direction, preferredUp);
    if (glm::length(right) < 1e-4f * glm::length(preferredUp) || glm::length(preferredUp) == 0) {
        right = glm::cross(direction, std::abs(direction.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1));
    }
    right = glm::normalize(right);
    return {right, glm::cross(right, direction)};
}

View makeView(const scene::Camera& camera, float aspect, const scene::Bounds& bounds) {
    check(camera, aspect);
    View view;
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const Axes axes = axesAround(forward, camera.up);
    const glm::mat3 viewFromWorld = glm::transpose(glm::mat3(axes.right, axes.up, -forward));
    view.viewFromWorld = glm::mat4(viewFromWorld);
    view.viewFromWorld[3] = glm::vec4(-(viewFromWorld * camera.position), 1);
    view.perspective = camera.projection == scene::ProjectionKind::Perspective;
    fitPlanes(view, camera, bounds);

    const float n = view.nearPlane;
    const float f = view.farPlane;
    glm::mat4& p = view.clipFromView;
    p = glm::mat4(0);
    if (view.perspective) {
        const float focal = 1 / std::tan(camera.verticalFieldOfView / 2);
        p[0][0] = focal / aspect;
        p[1][1] = -focal;
        p[2] = {-camera.offCenter.x, camera.offCenter.y, n / (f - n), -1};
        p[3][2] = n * f / (f - n);
    } else {
        p[0][0] = 2 / (camera.orthographicHeight * aspect);
        p[1][1] = -2 / camera.orthographicHeight;
        p[2][2] = 1 / (f - n);
        p[3] = {camera.offCenter.x, -camera.offCenter.y, f / (f - n), 1};
    }
    return view;
}

} // namespace nacre::renderer
