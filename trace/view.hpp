// The rays of a scene's camera, the same as the renderer's.
#pragma once

#include "trace/geometry.hpp"

namespace nacre::trace {

class View {
public:
    /// Throws SceneError naming the camera's field that makes no picture.
    View(const scene::Camera& camera, std::uint32_t width, std::uint32_t height);

    /// Through the point x, y of the picture, px; (0.5, 0.5) is the middle of the upper left pixel. Between the
    /// camera's near and far planes where it has its own.
    Ray ray(double x, double y) const;
    /// Where the picture shows `position`, px; nothing when that is behind the camera.
    std::optional<glm::dvec2> project(const glm::dvec3& position) const;
    /// A ray from `position` back to the camera.
    Ray rayBack(const glm::dvec3& position) const;

private:
    glm::dvec3 position_{0};
    glm::dvec3 right_{1, 0, 0};
    glm::dvec3 up_{0, 1, 0};
    glm::dvec3 forward_{0, 0, -1};
    bool perspective_ = true;
    glm::dvec2 size_{1};   ///< of the picture, px
    glm::dvec2 half_{1};   ///< half the picture: tangents of angles, or scene units when orthographic
    glm::dvec2 offset_{0}; ///< Camera::offCenter
    double nearPlane_ = 0;
    double farPlane_ = 0; ///< 0 = none
};

} // namespace nacre::trace
