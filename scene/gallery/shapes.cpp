#include "scene/gallery/shapes.hpp"

namespace nacre::scene::gallery {

std::vector<TubePoint> smoothTube(std::span<const TubePoint> points, int steps) {
    std::vector<TubePoint> curve;
    const auto at = [&](std::ptrdiff_t i) {
        return points[std::size_t(std::clamp<std::ptrdiff_t>(i, 0, std::ptrdiff_t(points.size()) - 1))];
    };
    const auto spline = [](auto a, auto b, auto c, auto d, float t) {
        return 0.5f * (2.f * b + (c - a) * t + (2.f * a - 5.f * b + 4.f * c - d) * (t * t) +
                       (3.f * b - a - 3.f * c + d) * (t * t * t));
    };
    for (std::ptrdiff_t i = 0; i + 1 < std::ptrdiff_t(points.size()); ++i)
        for (int s = 0; s < steps; ++s) {
            const TubePoint a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
            const float t = float(s) / float(steps);
            curve.push_back({spline(a.center, b.center, c.center, d.center, t),
                             std::max(0.1f, spline(a.radius, b.radius, c.radius, d.radius, t))});
        }
    curve.push_back(points.back());
    return curve;
}

void addSphere(ImplicitSurface& surface, const glm::vec3& center, float radius, float blend) {
    surface.add(boundsOf({center}, radius), blend,
                [=](const glm::vec3& p) { return sphereDistance(p, center, radius); });
}

void addEllipsoid(ImplicitSurface& surface, const glm::vec3& center, const glm::vec3& radii, float blend) {
    surface.add(boundsOf(center, radii), blend,
                [=](const glm::vec3& p) { return ellipsoidDistance(p, center, radii); });
}

void carveEllipsoid(ImplicitSurface& surface, const glm::vec3& center, const glm::vec3& radii, float blend) {
    surface.carve(boundsOf(center, radii), blend,
                  [=](const glm::vec3& p) { return ellipsoidDistance(p, center, radii); });
}

void addCapsule(ImplicitSurface& surface, TubePoint a, TubePoint b, float blend) {
    surface.add(boundsOf({a.center, b.center}, std::max(a.radius, b.radius)), blend,
                [=](const glm::vec3& p) { return taperedCapsuleDistance(p, a.center, b.center, a.radius, b.radius); });
}

namespace {

/// Some neighbouring capsules of a tube and the sphere they lie in.
struct TubeChunk {
    std::vector<TubePoint> points;
    glm::vec3 center{0};
    float radius = 0;
};

std::vector<TubeChunk> chunksOf(std::span<const TubePoint> points) {
    constexpr std::size_t capsules = 4;
    std::vector<TubeChunk> chunks;
    for (std::size_t first = 0; first + 1 < points.size(); first += capsules) {
        const std::size_t last = std::min(first + capsules, points.size() - 1);
        TubeChunk chunk;
        chunk.points.assign(points.begin() + std::ptrdiff_t(first), points.begin() + std::ptrdiff_t(last) + 1);
        chunk.center = 0.5f * (points[first].center + points[last].center);
        for (const TubePoint& point : chunk.points)
            chunk.radius = std::max(chunk.radius, glm::length(point.center - chunk.center) + point.radius);
        chunks.push_back(std::move(chunk));
    }
    return chunks;
}

float tubeDistance(const glm::vec3& p, std::span<const TubeChunk> chunks) {
    float nearest = std::numeric_limits<float>::max();
    for (const TubeChunk& chunk : chunks) {
        if (glm::length(p - chunk.center) - chunk.radius > nearest)
            continue;
        for (std::size_t i = 0; i + 1 < chunk.points.size(); ++i) {
            const TubePoint &a = chunk.points[i], &b = chunk.points[i + 1];
            nearest = std::min(nearest, taperedCapsuleDistance(p, a.center, b.center, a.radius, b.radius));
        }
    }
    return nearest;
}

Bounds boundsOf(std::span<const TubePoint> points) {
    Bounds bounds;
    for (const TubePoint& point : points) {
        bounds.low = glm::min(bounds.low, point.center - point.radius);
        bounds.high = glm::max(bounds.high, point.center + point.radius);
    }
    return bounds;
}

} // namespace

void addTube(ImplicitSurface& surface, std::span<const TubePoint> points, float blend) {
    surface.add(boundsOf(points), blend,
                [chunks = chunksOf(points)](const glm::vec3& p) { return tubeDistance(p, chunks); });
}

void carveTube(ImplicitSurface& surface, std::span<const TubePoint> points, float blend) {
    surface.carve(boundsOf(points), blend,
                  [chunks = chunksOf(points)](const glm::vec3& p) { return tubeDistance(p, chunks); });
}

void addPlate(ImplicitSurface& surface, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float radius,
              float blend) {
    surface.add(boundsOf({a, b, c}, radius), blend,
                [=](const glm::vec3& p) { return plateDistance(p, a, b, c, radius); });
}

} // namespace nacre::scene::gallery
