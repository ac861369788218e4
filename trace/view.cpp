#include "trace/view.hpp"

#include <cmath>
#include <numbers>

namespace nacre::trace {
namespace {

glm::dvec3 rightOf(const glm::dvec3& forward, const glm::dvec3& up) {
    const glm::dvec3 right = glm::cross(forward, up);
    if (glm::length(right) >= 1e-4 * glm::length(up) && glm::length(up) > 0) {
        return glm::normalize(right);
    }
    return glm::normalize(glm::cross(forward, std::abs(forward.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1)));
}

} // namespace

View::View(const scene::Camera& camera, std::uint32_t width, std::uint32_t height)
    : position_(camera.position),
      perspective_(camera.projection == scene::ProjectionKind::Perspective),
      size_(width, height),
      offset_(camera.offCenter),
      nearPlane_(camera.nearPlane),
      farPlane_(camera.farPlane) {
    const glm::dvec3 way = glm::dvec3(camera.target) - position_;
    const double extent = perspective_ ? camera.verticalFieldOfView : camera.orthographicHeight;
    if (!(glm::length(way) > 0) || !(extent > 0) || (perspective_ && extent >= std::numbers::pi)) {
        throw scene::SceneError("the camera '" + camera.name + "' " +
                                (glm::length(way) > 0 ? "has a field of view or height of " + std::to_string(extent)
                                                      : std::string("has its target where it stands")));
    }
    forward_ = glm::normalize(way);
    right_ = rightOf(forward_, camera.up);
    up_ = glm::cross(right_, forward_);
    half_.y = perspective_ ? std::tan(extent / 2) : extent / 2;
    half_.x = half_.y * size_.x / size_.y;
}

Ray View::ray(double x, double y) const {
    const double across = (2 * x / size_.x - 1 - offset_.x) * half_.x;
    const double down = (2 * y / size_.y - 1 + offset_.y) * half_.y;
    const glm::dvec3 aside = across * right_ - down * up_;
    // The direction's component along the view is 1, so that distances along the ray are depths.
    Ray result;
    result.origin = glm::vec3(perspective_ ? position_ : position_ + aside);
    result.direction = glm::vec3(perspective_ ? forward_ + aside : forward_);
    result.tNear = static_cast<float>(nearPlane_);
    if (farPlane_ > 0) {
        result.tFar = static_cast<float>(farPlane_);
    }
    return result;
}

std::optional<glm::dvec2> View::project(const glm::dvec3& position) const {
    const glm::dvec3 offset = position - position_;
    const double depth = glm::dot(offset, forward_);
    if (perspective_ && !(depth > 0)) {
        return std::nullopt;
    }
    const glm::dvec2 aside =
        glm::dvec2(glm::dot(offset, right_), -glm::dot(offset, up_)) / (perspective_ ? depth : 1.0);
    return glm::dvec2((aside.x / half_.x + 1 + offset_.x) * size_.x / 2,
                      (aside.y / half_.y + 1 - offset_.y) * size_.y / 2);
}

Ray View::rayBack(const glm::dvec3& position) const {
    Ray result;
    result.origin = glm::vec3(position);
    result.direction = perspective_ ? glm::vec3(position_ - position) : glm::vec3(-forward_);
    if (perspective_) {
        result.tFar = 1;
    }
    return result;
}

} // namespace nacre::trace
