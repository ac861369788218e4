// How a mouse moves a camera.
#pragma once

#include "scene/scene.hpp"

namespace nacre::view {

/// Unit vectors of a camera's picture.
struct CameraAxes {
    glm::vec3 right;
    glm::vec3 up;
    glm::vec3 forward;
};
CameraAxes axesOf(const scene::Camera& camera);

/// Scene units that the picture is high where the target is.
float heightAtTarget(const scene::Camera& camera);

/// Moves around the target: `turn` [rad], right and up. The camera never passes over the poles of its up vector.
void orbit(scene::Camera& camera, glm::vec2 turn);
/// Moves camera and target in the picture's plane; `share` of the picture's height, right and down.
void pan(scene::Camera& camera, glm::vec2 share);
/// Brings the camera closer to its target (factor < 1) or farther from it; an orthographic one shows less or more.
void zoom(scene::Camera& camera, float factor);
/// Moves camera and target: `steps` are right, up and forward in the camera's own axes, scene units.
void fly(scene::Camera& camera, const glm::vec3& steps);
/// Turns the camera where it stands: `turn` [rad], right and up.
void look(scene::Camera& camera, glm::vec2 turn);

} // namespace nacre::view
