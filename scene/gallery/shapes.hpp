// Signed distances of basic shapes and the boxes they lie in. Formulas: Quilez, "distance functions" (2008 on).
#pragma once

#include "scene/gallery/implicit_surface.hpp"
#include "scene/gallery/portable_math.hpp"

#include <span>

namespace nacre::scene::gallery {

/// The smaller of two distances, the crease between them rounded over `blend` mm (Quilez, "smooth minimum", 2013: the
/// polynomial one, no effect where the two differ by more than `blend`).
inline float smoothMinimum(float a, float b, float blend) {
    const float h = std::max(blend - std::abs(a - b), 0.f);
    return std::min(a, b) - (blend > 0 ? 0.25f * h * h / blend : 0.f);
}

inline float smoothMaximum(float a, float b, float blend) {
    return -smoothMinimum(-a, -b, blend);
}

inline float sphereDistance(const glm::vec3& p, const glm::vec3& center, float radius) {
    return glm::length(p - center) - radius;
}

/// First-order estimate, exact on the surface.
inline float ellipsoidDistance(const glm::vec3& p, const glm::vec3& center, const glm::vec3& radii) {
    const glm::vec3 q = p - center;
    const float k = glm::length(q / radii), gradient = glm::length(q / (radii * radii));
    return gradient > 0 ? k * (k - 1) / gradient : -std::min({radii.x, radii.y, radii.z});
}

/// A capsule whose radius goes linearly from `ra` at a to `rb` at b.
inline float taperedCapsuleDistance(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, float ra, float rb) {
    const glm::vec3 axis = b - a;
    const float t = glm::clamp(glm::dot(p - a, axis) / glm::dot(axis, axis), 0.f, 1.f);
    return glm::length(p - a - t * axis) - glm::mix(ra, rb, t);
}

inline float roundedBoxDistance(const glm::vec3& p, const glm::vec3& center, const glm::vec3& halfSize, float radius) {
    const glm::vec3 q = glm::abs(p - center) - halfSize + radius;
    return glm::length(glm::max(q, 0.f)) + std::min(std::max({q.x, q.y, q.z}), 0.f) - radius;
}

/// Distance to the triangle abc, thickened by `radius` on all sides.
inline float plateDistance(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                           float radius) {
    const glm::vec3 ba = b - a, cb = c - b, ac = a - c, pa = p - a, pb = p - b, pc = p - c;
    const glm::vec3 normal = glm::cross(ba, ac);
    const bool beside = glm::dot(glm::cross(ba, normal), pa) < 0 || glm::dot(glm::cross(cb, normal), pb) < 0 ||
                        glm::dot(glm::cross(ac, normal), pc) < 0;
    const auto toSegment = [](const glm::vec3& edge, const glm::vec3& q) {
        const glm::vec3 d = edge * glm::clamp(glm::dot(edge, q) / glm::dot(edge, edge), 0.f, 1.f) - q;
        return glm::dot(d, d);
    };
    const float square = beside ? std::min({toSegment(ba, pa), toSegment(cb, pb), toSegment(ac, pc)})
                                : glm::dot(normal, pa) * glm::dot(normal, pa) / glm::dot(normal, normal);
    return std::sqrt(square) - radius;
}

/// Box about spheres.
inline Bounds boundsOf(std::initializer_list<glm::vec3> centers, float radius) {
    Bounds b;
    for (const glm::vec3& c : centers) {
        b.low = glm::min(b.low, c - radius);
        b.high = glm::max(b.high, c + radius);
    }
    return b;
}

inline Bounds boundsOf(const glm::vec3& center, const glm::vec3& halfSize) {
    return {center - halfSize, center + halfSize};
}

/// A point of a tube: where and how thick.
struct TubePoint {
    glm::vec3 center{0};
    float radius = 1;
};

/// A Catmull-Rom curve through `points`, sampled `steps` times a span.
std::vector<TubePoint> smoothTube(std::span<const TubePoint> points, int steps);

void addSphere(ImplicitSurface& surface, const glm::vec3& center, float radius, float blend);
void addEllipsoid(ImplicitSurface& surface, const glm::vec3& center, const glm::vec3& radii, float blend);
void carveEllipsoid(ImplicitSurface& surface, const glm::vec3& center, const glm::vec3& radii, float blend);
void addCapsule(ImplicitSurface& surface, TubePoint a, TubePoint b, float blend);
/// A chain of capsules as one shape.
void addTube(ImplicitSurface& surface, std::span<const TubePoint> points, float blend);
void carveTube(ImplicitSurface& surface, std::span<const TubePoint> points, float blend);
void addPlate(ImplicitSurface& surface, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float radius,
              float blend);

/// Calls `build` for x and for its mirror image, side = +1 and −1.
template <typename Build> void bothSides(Build build) {
    build(1.f);
    build(-1.f);
}

} // namespace nacre::scene::gallery
