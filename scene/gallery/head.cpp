#include "scene/gallery/bodies.hpp"
#include "scene/gallery/shapes.hpp"

#include <array>

namespace nacre::scene::gallery {

namespace {

float bell(float x) {
    return exponential(-x * x);
}

void addSkull(ImplicitSurface& head) {
    addEllipsoid(head, {0, 150, -8}, {74, 82, 97}, 0);
    addEllipsoid(head, {0, 160, 34}, {60, 50, 54}, 30);
    addEllipsoid(head, {0, 88, 26}, {59, 80, 60}, 25);
    addEllipsoid(head, {0, 47, 74}, {31, 30, 24}, 16);
    bothSides([&](float side) {
        addTube(
            head,
            std::array<TubePoint, 3>{{{{side * 57, 98, 2}, 17}, {{side * 50, 44, 10}, 18}, {{side * 13, 12, 72}, 15}}},
            24);
        addEllipsoid(head, {side * 45, 93, 60}, {19, 13, 20}, 22);
        addTube(head,
                std::array<TubePoint, 3>{
                    {{{side * 10, 131, 83}, 8}, {{side * 30, 137, 78}, 7.5f}, {{side * 51, 131, 57}, 6}}},
                16);
        carveEllipsoid(head, {side * 80, 58, 66}, {22, 30, 30}, 24);
    });
    addEllipsoid(head, {0, 12, 76}, {17, 14, 15}, 16);
}

void addNeck(ImplicitSurface& head) {
    addCapsule(head, {{0, 50, -22}, 52}, {{0, -100, -34}, 60}, 22);
    bothSides([&](float side) {
        addTube(
            head,
            std::array<TubePoint, 3>{{{{side * 60, 74, -26}, 10}, {{side * 46, 10, 4}, 10}, {{side * 13, -70, 32}, 8}}},
            14);
        addCapsule(head, {{side * 30, 10, -55}, 26}, {{side * 70, -100, -50}, 34}, 26);
    });
    addEllipsoid(head, {0, -6, 28}, {10, 15, 12}, 12);
    head.carve(boundsOf({0, -130, -30}, {160, 55, 160}), 6, [](const glm::vec3& p) { return p.y + 78; });
}

void addNose(ImplicitSurface& head) {
    addTube(
        head,
        smoothTube(
            std::array<TubePoint, 4>{{{{0, 128, 82}, 9}, {{0, 112, 91}, 7}, {{0, 96, 101}, 7}, {{0, 82, 109}, 8}}}, 4),
        10);
    addEllipsoid(head, {0, 77.5f, 111}, {9.5f, 8.5f, 9}, 6);
    bothSides([&](float side) { addEllipsoid(head, {side * 12, 73.5f, 100}, {6.5f, 7, 9}, 5); });
    addCapsule(head, {{0, 71, 111}, 3.5f}, {{0, 66, 98}, 4}, 5);
    bothSides([&](float side) { carveEllipsoid(head, {side * 6.8f, 68.5f, 103}, {3.2f, 4, 6}, 2); });
}

void addEye(ImplicitSurface& head, float side) {
    carveEllipsoid(head, {side * 33, 117, 93}, {19, 12, 15}, 12);
    addSphere(head, {side * 32, 115, 73.5f}, 15, 5);
    // Closed lids: the lash line with the upper lid over the lower one, and the crease above.
    head.emboss(boundsOf({side * 32, 116, 84}, {24, 18, 16}), [side](const glm::vec3& p) {
        const float u = side * p.x - 32, v = p.y - 115, w = u / 17;
        const float fade = bell(w * w * w * 0.8f) * smoothStep(74, 78, p.z);
        const float lash = v + 6.5f - 6 * w * w + 1.2f * w, crease = v - 8.5f + 5.5f * w * w;
        const float step = smoothStep(-0.8f, 0.8f, lash) * smoothStep(9, 1, lash);
        return fade * (0.9f * step - 0.7f * bell((lash + 0.8f) / 1.0f) - 1.3f * bell(crease / 1.8f));
    });
}

void addMouth(ImplicitSurface& head) {
    bothSides([&](float side) {
        addTube(head,
                smoothTube(std::array<TubePoint, 4>{{{{0, 51.5f, 98}, 4},
                                                     {{side * 6, 52.8f, 98}, 4.2f},
                                                     {{side * 15, 50, 93.5f}, 3.4f},
                                                     {{side * 26, 45.5f, 84}, 1.5f}}},
                           4),
                4);
        addTube(head,
                smoothTube(std::array<TubePoint, 4>{{{{0, 41.5f, 97}, 5.2f},
                                                     {{side * 9, 42, 96}, 5},
                                                     {{side * 18, 44, 91}, 3.6f},
                                                     {{side * 26, 45.5f, 84}, 1.5f}}},
                           4),
                4);
    });
    bothSides([&](float side) {
        head.carve(boundsOf({side * 14, 47, 95}, {16, 6, 14}), 2.2f,
                   [tube = smoothTube(std::array<TubePoint, 4>{{{{0, 46.4f, 102}, 1},
                                                                {{side * 8, 47.2f, 101}, 1},
                                                                {{side * 17, 46.6f, 96}, 1},
                                                                {{side * 27, 45, 86.5f}, 0.8f}}},
                                      3)](const glm::vec3& p) {
                       float nearest = 1e3f;
                       for (std::size_t i = 0; i + 1 < tube.size(); ++i)
                           nearest = std::min(nearest, taperedCapsuleDistance(p, tube[i].center, tube[i + 1].center,
                                                                              tube[i].radius, tube[i + 1].radius));
                       return nearest;
                   });
    });
    head.emboss(boundsOf({0, 60, 98}, {14, 14, 20}), [](const glm::vec3& p) {
        return -1.1f * bell(p.x / 2.8f) * smoothStep(54, 57, p.y) * smoothStep(68, 63, p.y) * smoothStep(84, 90, p.z);
    });
    carveEllipsoid(head, {0, 31, 103}, {17, 6, 9}, 9);
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
        const float sheet = std::abs(q.z - hollow) - 1.3f;
        return 0.85f * std::max(outline, sheet);
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

} // namespace

Body makeHead(std::size_t triangles) {
    ImplicitSurface head;
    addSkull(head);
    addNeck(head);
    addNose(head);
    bothSides([&](float side) { addEye(head, side); });
    addMouth(head);
    bothSides([&](float side) { addEar(head, side); });
    return makeBody(head, 1.25f, triangles);
}

} // namespace nacre::scene::gallery
