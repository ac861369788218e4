#include "scene/gallery/bodies.hpp"
#include "scene/gallery/noise.hpp"
#include "scene/gallery/shapes.hpp"

#include <array>

namespace nacre::scene::gallery {

namespace {

constexpr float eyeRadius = 12;

/// The middle of the ball that the lids lie on.
glm::vec3 eyeMiddle(float side) {
    return {side * 32, 115, 73};
}

float bell(float x) {
    return exponential(-x * x);
}

void addSkull(ImplicitSurface& head) {
    addEllipsoid(head, {0, 150, -8}, {74, 82, 97}, 0);
    addEllipsoid(head, {0, 160, 34}, {60, 50, 54}, 30);
    addEllipsoid(head, {0, 88, 26}, {59, 80, 60}, 25);
    addEllipsoid(head, {0, 48, 72}, {33, 32, 26}, 18);
    bothSides([&](float side) {
        addTube(
            head,
            std::array<TubePoint, 3>{{{{side * 56, 98, 2}, 17}, {{side * 49, 44, 10}, 17}, {{side * 12, 13, 72}, 15}}},
            26);
        addEllipsoid(head, {side * 44, 93, 56}, {20, 12, 19}, 28);
        addTube(head,
                std::array<TubePoint, 3>{
                    {{{side * 9, 130, 82}, 8}, {{side * 30, 136.5f, 77}, 7.5f}, {{side * 50, 130, 54}, 5}}},
                18);
        carveEllipsoid(head, {side * 81, 58, 64}, {22, 32, 32}, 28);
    });
    addEllipsoid(head, {0, 12, 76}, {16, 13, 15}, 16);
}

void addNeck(ImplicitSurface& head) {
    addCapsule(head, {{0, 50, -24}, 50}, {{0, -110, -38}, 56}, 24);
    bothSides([&](float side) {
        addTube(head,
                smoothTube(
                    std::array<TubePoint, 3>{
                        {{{side * 60, 76, -28}, 9}, {{side * 46, 10, -2}, 10}, {{side * 12, -72, 26}, 8}}},
                    4),
                16);
        addTube(head,
                smoothTube(
                    std::array<TubePoint, 3>{
                        {{{side * 26, 30, -62}, 22}, {{side * 40, -30, -60}, 26}, {{side * 78, -92, -50}, 26}}},
                    4),
                26);
    });
    addEllipsoid(head, {0, -112, -32}, {112, 56, 62}, 40);
    addEllipsoid(head, {0, -4, 24}, {9, 15, 12}, 14);
    head.carve(boundsOf({0, -130, -30}, {170, 60, 170}), 8, [](const glm::vec3& p) { return p.y + 74; });
}

void addNose(ImplicitSurface& head) {
    addTube(
        head,
        smoothTube(
            std::array<TubePoint, 4>{{{{0, 128, 84}, 9}, {{0, 112, 88}, 8}, {{0, 96, 95}, 9.5f}, {{0, 83, 101}, 11}}},
            4),
        9);
    addCapsule(head, {{0, 100, 78}, 15}, {{0, 76, 88}, 14}, 12);
    addTube(head,
            smoothTube(
                std::array<TubePoint, 4>{
                    {{{0, 118, 91}, 4}, {{0, 104, 97.5f}, 5.2f}, {{0, 93, 103}, 5.5f}, {{0, 82, 109}, 6.5f}}},
                4),
            6);
    addEllipsoid(head, {0, 77.5f, 110.5f}, {8.8f, 8, 8.5f}, 6);
    bothSides([&](float side) { addEllipsoid(head, {side * 12, 74, 99}, {6, 7, 10}, 5); });
    addCapsule(head, {{0, 71, 110}, 3.2f}, {{0, 67, 97}, 4}, 5);
    bothSides([&](float side) {
        head.carve(boundsOf({side * 6.6f, 68, 102}, {4, 5, 7}), 2, [side](const glm::vec3& p) {
            return ellipsoidDistance(p, {side * (6.8f - 0.12f * (p.z - 102)), 67.5f, 102}, {2.8f, 4, 5.5f});
        });
    });
}

void carveSocket(ImplicitSurface& head, float side) {
    carveEllipsoid(head, {side * 34, 117, 94}, {17, 11, 15}, 14);
}

/// The upper lid comes down over the lower one along the lash line; a crease above.
void addClosedEye(ImplicitSurface& head, float side) {
    carveSocket(head, side);
    addEllipsoid(head, {side * 32, 115, 73.5f}, {19, 14.5f, 15}, 7);
    head.emboss(boundsOf({side * 32, 116, 84}, {26, 20, 18}), [side](const glm::vec3& p) {
        const float u = side * p.x - 32, v = p.y - 115, w = u / 17;
        const float fade = bell(0.75f * w * w * w) * smoothStep(68, 76, p.z);
        const float lash = v + 6.8f - 6 * w * w + 1.3f * w, crease = v - 8.5f + 5.5f * w * w;
        const float step = smoothStep(-0.9f, 0.9f, lash) * smoothStep(10, 1, lash);
        return fade * (1.0f * step - 0.6f * bell((lash + 0.9f) / 1.1f) - 1.1f * bell(crease / 2));
    });
}

/// A place around the middle of an eye's ball.
struct EyePlace {
    float outward; ///< [rad] from straight ahead to the temple
    float up;      ///< [rad]
    float radius;  ///< [mm]

    EyePlace(const glm::vec3& p, float side) {
        const glm::vec3 d = p - eyeMiddle(side);
        outward = arcTangent(side * d.x, d.z);
        up = arcTangent(d.y, std::sqrt(d.x * d.x + d.z * d.z));
        radius = glm::length(d);
    }
    /// From -1 at the inner corner of the lids to 1 at the outer one.
    float across() const { return outward / (outward > 0 ? 1.11f : 1.0f); }
};

/// The line through both corners [rad upwards]: the outer one is higher.
float cornerLine(float across) {
    return 0.07f * across;
}

/// The edges of the open lids [rad upwards].
float upperEdge(float across) {
    const float open = 1 - across * across;
    return cornerLine(across) + 0.39f * open * (1 + 0.25f * across * across) * (1 - 0.15f * across);
}

float lowerEdge(float across) {
    const float open = 1 - across * across;
    return cornerLine(across) - 0.46f * open * (1 + 0.15f * across);
}

/// Distance to a lid's edge [mm], positive above it.
float aboveEdge(const EyePlace& place, float (*edge)(float)) {
    const float w = place.across(), slope = edge(w + 0.5f) - edge(w - 0.5f);
    return place.radius * (place.up - edge(w)) / std::sqrt(1 + slope * slope);
}

/// The opening between the lids is a cone from the middle of the ball, so that their rims stand on the ball. It ends
/// behind the iris, and in front of the lids, or it would cut the side of the nose.
float openingDistance(const EyePlace& place) {
    const float between = smoothMaximum(aboveEdge(place, upperEdge), -aboveEdge(place, lowerEdge), 1);
    return std::max(smoothMaximum(between, place.radius - eyeRadius - 4.5f, 2), eyeRadius - 4 - place.radius);
}

void addOpenEye(ImplicitSurface& head, float side) {
    const glm::vec3 middle = eyeMiddle(side);
    carveSocket(head, side);
    addEllipsoid(head, middle, {eyeRadius + 2.5f, eyeRadius + 2.2f, eyeRadius + 2.2f}, 5);
    head.emboss(boundsOf(middle + glm::vec3(0, 4, 8), {22, 20, 18}), [side](const glm::vec3& p) {
        const EyePlace place(p, side);
        const float w = place.across(), crease = place.up - 0.72f + 0.45f * w * w;
        const float fade = smoothStep(1.1f, 0.6f, std::abs(w)) * smoothStep(19, 16, place.radius);
        return fade * (0.7f * bell((crease - 0.14f) / 0.12f) - 1.5f * bell(crease / 0.075f));
    });
    head.carve(boundsOf({middle}, eyeRadius + 6), 1.2f,
               [side](const glm::vec3& p) { return openingDistance(EyePlace(p, side)); });
    // The caruncle, in the inner corner.
    addEllipsoid(head, middle + eyeRadius * glm::vec3(side * -0.735f, -0.07f, 0.67f), {1.5f, 1.3f, 1.3f}, 1.6f);
}

void addMouth(ImplicitSurface& head) {
    bothSides([&](float side) {
        addTube(head,
                smoothTube(std::array<TubePoint, 4>{{{{0, 51.2f, 96.4f}, 4},
                                                     {{side * 5.5f, 52.2f, 96.4f}, 4.3f},
                                                     {{side * 14, 49.8f, 92.5f}, 3.3f},
                                                     {{side * 24, 46, 84}, 1.5f}}},
                           4),
                5);
        addTube(head,
                smoothTube(std::array<TubePoint, 4>{{{{0, 41.2f, 95.8f}, 5.4f},
                                                     {{side * 8, 42, 95}, 5.2f},
                                                     {{side * 16, 43.8f, 90.5f}, 3.5f},
                                                     {{side * 24, 46, 84}, 1.5f}}},
                           4),
                5);
    });
    bothSides([&](float side) {
        const std::vector<TubePoint> parting = smoothTube(std::array<TubePoint, 4>{{{{0, 46.4f, 100.5f}, 0.8f},
                                                                                    {{side * 7, 47.1f, 100}, 0.8f},
                                                                                    {{side * 15, 46.6f, 96}, 0.8f},
                                                                                    {{side * 25, 45.4f, 88}, 0.7f}}},
                                                          3);
        carveTube(head, parting, 3);
    });
    // The groove below the nose, the folds beside the mouth, the hollow above the chin.
    head.emboss(boundsOf({0, 61, 98}, {14, 14, 20}), [](const glm::vec3& p) {
        return -1.0f * bell(p.x / 2.8f) * smoothStep(54, 58, p.y) * smoothStep(68, 63, p.y) * smoothStep(84, 90, p.z);
    });
    bothSides([&](float side) {
        head.emboss(boundsOf({side * 28, 58, 86}, {20, 22, 26}), [side](const glm::vec3& p) {
            const float x = side * p.x, fold = x - 30 + 0.55f * (p.y - 48);
            return 0.4f * (bell((fold - 4) / 4) - bell(fold / 2.2f)) * bell((p.y - 60) / 13) * smoothStep(66, 74, p.z) *
                   smoothStep(48, 42, x);
        });
    });
    carveEllipsoid(head, {0, 31.5f, 104}, {17, 5.5f, 9}, 10);
}

/// Ear coordinates: x backward along the ear's sheet, y up, z out of it.
struct EarFrame {
    glm::vec3 origin, back, up, out;

    explicit EarFrame(float side)
        : origin(side * 68, 103, -6),
          back(glm::normalize(glm::vec3(side * 0.52f, -0.08f, -0.85f))),
          up(glm::normalize(glm::vec3(side * 0.10f, 0.97f, -0.20f))) {
        up = glm::normalize(up - glm::dot(up, back) * back);
        out = glm::cross(back, up) * (side > 0 ? -1.f : 1.f);
        if (out.x * side < 0)
            out = -out;
    }
    glm::vec3 world(const glm::vec3& q) const { return origin + q.x * back + q.y * up + q.z * out; }
    glm::vec3 local(const glm::vec3& p) const {
        const glm::vec3 d = p - origin;
        return {glm::dot(d, back), glm::dot(d, up), glm::dot(d, out)};
    }
};

void addEar(ImplicitSurface& head, float side) {
    const EarFrame ear(side);
    const auto tube = [&](std::initializer_list<TubePoint> points, float blend) {
        std::vector<TubePoint> world(points);
        for (TubePoint& point : world)
            point.center = ear.world(point.center);
        addTube(head, smoothTube(world, 6), blend);
    };
    // The sheet: an egg, hollowed towards the ear's opening.
    head.add(boundsOf(ear.world({14, 0, 0}), {26, 38, 28}), 4, [ear](const glm::vec3& p) {
        const glm::vec3 q = ear.local(p);
        const float width = 17 + 3.5f * q.y / 32, x = (q.x - 15) / width, y = q.y / 31;
        const float outline = (std::sqrt(x * x + y * y) - 1) * 17;
        const float hollow =
            2.5f - 9 * bell((q.x - 9) / 9) * bell((q.y + 5) / 12) - 2.5f * bell((q.x - 22) / 6) * bell((q.y - 8) / 16);
        const float sheet = std::abs(q.z - hollow) - 1.1f;
        return 0.85f * smoothMaximum(outline, sheet, 2);
    });
    tube({{{6, -2, 0}, 2.2f},
          {{2, 6, 3}, 2.6f},
          {{3, 22, 5}, 2.6f},
          {{13, 31, 6}, 2.6f},
          {{26, 27, 6}, 2.5f},
          {{33, 12, 5}, 2.4f},
          {{32, -4, 4}, 2.3f},
          {{26, -18, 3.5f}, 2.2f},
          {{17, -28, 3}, 2.6f}},
         2);
    tube({{{13, -17, 2.5f}, 2.4f},
          {{21, -11, 3}, 2.4f},
          {{23, 2, 3}, 2.3f},
          {{19, 12, 2.5f}, 2.1f},
          {{12, 21, 2}, 1.8f}},
         3);
    tube({{{2, -12, 2}, 3.2f}, {{3, -5, 4}, 3.6f}, {{2, 1, 2}, 3}}, 4);
    tube({{{12, -30, 2}, 4.2f}, {{8, -26, 1}, 4}, {{3, -20, 0}, 3.5f}}, 4);
}

ImplicitSurface sculptHead(void (*addEye)(ImplicitSurface& head, float side)) {
    ImplicitSurface head;
    addSkull(head);
    addNeck(head);
    addNose(head);
    bothSides([&](float side) { addEye(head, side); });
    addMouth(head);
    bothSides([&](float side) { addEar(head, side); });
    return head;
}

} // namespace

Body makeHead(std::size_t triangles) {
    ImplicitSurface head = sculptHead(addClosedEye);
    // Skin is not quite even.
    head.emboss(boundsOf({0, 80, 0}, {110, 160, 130}),
                [](const glm::vec3& p) { return 0.09f * noise(p / 8.f) + 0.05f * noise(p / 3.2f + glm::vec3(17)); });
    return makeBody(head, 1.25f, triangles);
}

Body makeOpenEyedHead(std::size_t triangles) {
    return makeBody(sculptHead(addOpenEye), 0.6f, triangles);
}

} // namespace nacre::scene::gallery
