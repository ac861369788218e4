#include "scene/gallery/bodies.hpp"
#include "scene/gallery/noise.hpp"
#include "scene/gallery/paint.hpp"
#include "scene/gallery/shapes.hpp"

namespace nacre::scene::gallery {

namespace {

constexpr float growth = 0.178f;     // ln of the radius per radian: a nautilus grows about threefold each turn
constexpr float mouthCenter = 62;    // mm from the axis to the tube's middle at the mouth, angle 0
constexpr float tubeRatio = 0.56f;   // tube radius by distance from the axis
constexpr float wall = 2.2f;         // mm
constexpr float chamberAngle = 5.2f; // rad; the living chamber reaches this far back from the mouth
constexpr float textureReach = 106;  // mm; the texture shows x and y of [-106, 106]

/// One whorl at a distance r from the axis; `angle` is along the spiral, 0 at the mouth and negative before it.
float whorlDistance(float r, float z, float angle) {
    const float center = mouthCenter * exponential(growth * angle);
    const float flare = smoothStep(-0.5f, 0, angle);
    const float radius = tubeRatio * center * (1 + 0.10f * flare);
    const float across = std::sqrt((r - center) * (r - center) + z * z / (0.88f * 0.88f));
    const float ribs = 0.12f * sine(58 * angle) * smoothStep(14, 40, center) * smoothStep(-0.05f, -0.3f, angle);
    const float outer = 0.9f * (across - radius - ribs);
    const float inner = 0.9f * (across - radius) + wall * (1 - 0.3f * flare);
    const float septum = (-angle - chamberAngle) * center;
    return smoothMaximum(std::max(outer, -std::max(inner, septum)), angle * center, 1.2f);
}

float shellDistance(const glm::vec3& p) {
    const float r = std::sqrt(p.x * p.x + p.y * p.y), angle = arcTangent(p.y, p.x);
    float nearest = ellipsoidDistance(p, {0, 0, 0}, {3, 3, 2.5f});
    for (int turn = -3; turn <= 0; ++turn)
        nearest = std::min(nearest, whorlDistance(r, p.z, angle + 2 * pi * float(turn)));
    return nearest;
}

/// Flames of brown from the navel outwards on the older half of the last whorl and all before it.
glm::vec3 shellColor(const glm::vec2& q) {
    const float r = glm::length(q), theta = arcTangent(q.y, q.x);
    float angle = theta, outside = mouthCenter * (1 + tubeRatio) * exponential(growth * angle);
    while (r < outside * 0.335f || angle > 0) { // the whorl before lies over this point
        angle -= 2 * pi;
        outside *= exponential(-2 * pi * growth);
        if (outside < 2)
            break;
    }
    const float across = r / outside, wobble = noise(glm::vec3(3 * across, 2.2f * angle, 3));
    const float wave = sine(9.5f * angle + 2.6f * across + 1.3f * wobble);
    const float cover = smoothStep(0.0f, 0.45f, wave + 0.25f * noise(glm::vec3(q / 3.f, 9))) *
                        smoothStep(-1.1f, -2.3f, angle + 0.9f * across + 0.5f * wobble);
    const glm::vec3 pearl = glm::vec3(0.90f, 0.85f, 0.79f) * (1 + 0.03f * noise(glm::vec3(q / 5.f, 1)));
    return glm::mix(pearl, glm::vec3(0.46f, 0.17f, 0.06f), 0.85f * cover);
}

} // namespace

Body makeShell(std::size_t triangles) {
    ImplicitSurface shell;
    shell.add(boundsOf({0, 0, 0}, {106, 100, 40}), 0, shellDistance);
    return makeBody(shell, 1, triangles);
}

glm::vec2 shellTextureCoordinates(const glm::vec3& p) {
    return glm::vec2(0.5f) + glm::vec2(p.x, -p.y) / (2 * textureReach);
}

Texture makeShellTexture() {
    return paint("shell", 512, [](const glm::vec2& uv) {
        return shellColor(glm::vec2(uv.x - 0.5f, 0.5f - uv.y) * (2 * textureReach));
    });
}

} // namespace nacre::scene::gallery
