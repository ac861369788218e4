#include "view/model/camera_control.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

/// [rad] nearest that the view direction comes to the up vector.
constexpr float poleDistance = 0.02f;
constexpr float nearestShare = 1e-4f; // of a distance, at one zoom

/// The vector turned to the right about the up axis, and up, stopping before the poles.
glm::vec3 turned(const scene::Camera& camera, const glm::vec3& vector, glm::vec2 turn) {
    const glm::vec3 axis = glm::normalize(camera.up);
    const glm::vec3 direction = glm::normalize(vector);
    const float fromPole = std::acos(std::clamp(glm::dot(direction, axis), -1.0f, 1.0f));
    const float rise = fromPole - std::clamp(fromPole - turn.y, poleDistance, glm::pi<float>() - poleDistance);
    const glm::vec3 right = glm::normalize(glm::cross(direction, axis));
    const glm::mat4 up = glm::rotate(glm::mat4(1), rise, right);
    const glm::mat4 around = glm::rotate(glm::mat4(1), -turn.x, axis);
    return glm::vec3(around * up * glm::vec4(vector, 0));
}

/// Planes that were fitted to the scene, as the camera's own would cut it where it moves.
void forgetPlanes(scene::Camera& camera) {
    camera.nearPlane = 0;
    camera.farPlane = 0;
}

} // namespace

CameraAxes axesOf(const scene::Camera& camera) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    glm::vec3 right = glm::cross(forward, camera.up);
    right = glm::length(right) > 1e-6f ? glm::normalize(right) : glm::vec3(1, 0, 0);
    return {right, glm::cross(right, forward), forward};
}

float heightAtTarget(const scene::Camera& camera) {
    return camera.projection == scene::ProjectionKind::Orthographic
               ? camera.orthographicHeight
               : 2 * glm::distance(camera.position, camera.target) * std::tan(camera.verticalFieldOfView / 2);
}

void orbit(scene::Camera& camera, glm::vec2 turn) {
    camera.position = camera.target + turned(camera, camera.position - camera.target, {turn.x, turn.y});
    forgetPlanes(camera);
}

void pan(scene::Camera& camera, glm::vec2 share) {
    const CameraAxes basis = axesOf(camera);
    const float height = heightAtTarget(camera);
    const glm::vec3 step = height * (-share.x * basis.right + share.y * basis.up);
    camera.position += step;
    camera.target += step;
    forgetPlanes(camera);
}

void zoom(scene::Camera& camera, float factor) {
    factor = std::max(factor, nearestShare);
    if (camera.projection == scene::ProjectionKind::Orthographic) {
        camera.orthographicHeight *= factor;
    } else {
        camera.position = camera.target + factor * (camera.position - camera.target);
    }
    forgetPlanes(camera);
}

void fly(scene::Camera& camera, const glm::vec3& steps) {
    const CameraAxes basis = axesOf(camera);
    const glm::vec3 step = steps.x * basis.right + steps.y * basis.up + steps.z * basis.forward;
    camera.position += step;
    camera.target += step;
    forgetPlanes(camera);
}

void look(scene::Camera& camera, glm::vec2 turn) {
    camera.target = camera.position + turned(camera, camera.target - camera.position, turn);
    forgetPlanes(camera);
}

} // namespace nacre::view
