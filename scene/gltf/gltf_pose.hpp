// How a node of a glTF document is turned.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <optional>

namespace nacre::scene {

/// A node's x, y or z axis (0, 1, 2) in the world, of unit length; nothing where its scale is 0.
inline std::optional<glm::vec3> unitAxis(const glm::mat4& transform, int axis) {
    const glm::dvec3 scaled(transform[axis]); // the square of a small float is 0
    const double length = glm::length(scaled);
    return length > 0 && std::isfinite(length) ? std::optional(glm::vec3(scaled / length)) : std::nullopt;
}

} // namespace nacre::scene
