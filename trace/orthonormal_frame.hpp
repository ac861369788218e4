// Orthonormal frames and directions about them.
#pragma once

#include "trace/random.hpp"

#include <glm/glm.hpp>

#include <cmath>
#include <numbers>

namespace nacre::trace {

/// Two unit vectors perpendicular to the unit vector `axis` and to each other.
struct Frame {
    explicit Frame(const glm::dvec3& axis) : normal(axis) {
        const glm::dvec3 other = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        tangent = glm::normalize(glm::cross(axis, other));
        bitangent = glm::cross(axis, tangent);
    }

    glm::dvec3 toWorld(double x, double y, double z) const { return x * tangent + y * bitangent + z * normal; }

    glm::dvec3 tangent;
    glm::dvec3 bitangent;
    glm::dvec3 normal;
};

/// The direction at the polar cosine [−1, 1] and the azimuth [rad] about the frame's normal.
inline glm::dvec3 directionAt(const Frame& frame, double cosine, double azimuth) {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return frame.toWorld(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
}

/// A direction about `normal` with the density cosine / π.
inline glm::dvec3 cosineDirection(const glm::dvec3& normal, Random& random) {
    const double cosine = std::sqrt(random.uniform());
    return directionAt(Frame(normal), cosine, 2 * std::numbers::pi * random.uniform());
}

} // namespace nacre::trace
