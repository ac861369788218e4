// Matrices of a scene's camera. Internal to the renderer.
#pragma once

#include "scene/scene.hpp"

#include <glm/glm.hpp>

namespace nacre::renderer {

/// A camera as matrices: view space looks along -Z, clip space is Vulkan's with depth reversed (1 near, 0 far).
struct View {
    glm::mat4 viewFromWorld{1};
    glm::mat4 clipFromView{1};
    bool perspective = true;
    float nearPlane = 0; ///< scene units
    float farPlane = 0;  ///< scene units
};

/// Near and far planes that the camera leaves at 0 are fitted to `bounds`. `aspect` is width / height.
/// Throws RendererError naming the camera's field that makes no picture.
View makeView(const scene::Camera& camera, float aspect, const scene::Bounds& bounds);

/// Two unit vectors that are perpendicular to the unit vector `direction` and to each other.
struct Axes {
    glm::vec3 right;
    glm::vec3 up;
};
Axes axesAround(const glm::vec3& direction, const glm::vec3& preferredUp = {0, 1, 0});

} // namespace nacre::renderer
