#include "scene/gallery/bodies.hpp"
#include "scene/gallery/shapes.hpp"

namespace nacre::scene::gallery {

namespace {

constexpr float growth = 0.178f;     // ln of the radius per radian: a nautilus grows about threefold each turn
constexpr float lastAngle = 0;       // the mouth lies at this angle of the last whorl
constexpr float mouthCenter = 56;    // mm from the axis to the tube's middle at the mouth
constexpr float tubeRatio = 0.56f;   // tube radius by distance from the axis
constexpr float wall = 2.2f;         // mm
constexpr float chamberAngle = 5.2f; // the living chamber reaches this far back from the mouth

/// One whorl seen from `p`: `angle` is along the spiral, 0 at the mouth and negative before it.
float whorlDistance(float r, float z, float angle) {
    const float center = mouthCenter * exponential(growth * angle);
    const float flare = 1 + 0.10f * smoothStep(-0.5f, 0, angle);
    const float radius = tubeRatio * center * flare;
    const float across = std::sqrt((r - center) * (r - center) + z * z / (0.88f * 0.88f));
    const float ribs = 0.22f * sine(64 * angle) * smoothStep(-0.05f, -0.3f, angle);
    const float outer = (across - radius - ribs) * 0.9f;
    const float thin = wall * (1 - 0.3f * smoothStep(-0.5f, 0, angle));
    const float inner = (across - radius) * 0.9f + thin;
    const float septum = (-angle - chamberAngle) * center;
    const float hollow = std::max(inner, septum);
    return std::max({outer, -hollow, (angle - lastAngle) * center});
}

float shellDistance(const glm::vec3& p) {
    const float r = std::sqrt(p.x * p.x + p.y * p.y);
    const float theta = arcTangent(p.y, p.x);
    float nearest = 1e3f;
    for (int turn = -3; turn <= 0; ++turn)
        nearest = std::min(nearest, whorlDistance(r, p.z, theta + 2 * pi * float(turn) + (theta > 0.6f ? 0.f : 0.f)));
    return std::min(nearest, ellipsoidDistance(p, {0, 0, 0}, {3, 3, 2.5f}));
}

} // namespace

Body makeShell(std::size_t triangles) {
    ImplicitSurface shell;
    shell.add(boundsOf({0, 0, 0}, {96, 90, 36}), 0, shellDistance);
    return makeBody(shell, 1, triangles);
}

} // namespace nacre::scene::gallery
