#include "scene/gallery/plinth.hpp"

#include "scene/gallery/portable_math.hpp"
#include "scene/gallery/solid.hpp"

#include <array>
#include <span>

namespace nacre::scene::gallery {

namespace {

/// Adds a flat convex polygon whose corners run counter-clockwise seen from the side that `outward` points to, or
/// clockwise: the order is turned round where needed.
void addPolygon(Mesh& mesh, std::span<const glm::vec3> corners, const glm::vec3& outward) {
    const glm::vec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const bool flip = glm::dot(cross, outward) < 0;
    const glm::vec3 normal = glm::normalize(flip ? -cross : cross);
    const auto first = std::uint32_t(mesh.vertices.size());
    for (const glm::vec3& corner : corners)
        mesh.vertices.push_back({corner, normal, anyTangent(normal), glm::vec2(0)});
    for (std::uint32_t i = 2; i < corners.size(); ++i)
        mesh.indices.insert(mesh.indices.end(), {first, first + (flip ? i : i - 1), first + (flip ? i - 1 : i)});
}

} // namespace

glm::vec4 anyTangent(const glm::vec3& normal) {
    const glm::vec3 helper = std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return {glm::normalize(glm::cross(helper, normal)), 1};
}

Mesh makeChamferedBox(const glm::vec3& halfSize, float chamfer) {
    Mesh mesh;
    mesh.name = "plinth";
    // The corner next to (sx, sy, sz) that lies in the face across `axis`.
    const auto corner = [&](int axis, const glm::vec3& signs) {
        glm::vec3 p = halfSize - chamfer;
        p[axis] = halfSize[axis];
        return p * signs;
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const float side : {-1.f, 1.f}) {
            std::array<glm::vec3, 4> face;
            for (int i = 0; i < 4; ++i) {
                glm::vec3 signs(side);
                signs[u] = i == 1 || i == 2 ? 1.f : -1.f;
                signs[v] = i >= 2 ? 1.f : -1.f;
                face[i] = corner(axis, signs);
            }
            glm::vec3 outward(0);
            outward[axis] = side;
            addPolygon(mesh, face, outward);
            for (const float other : {-1.f, 1.f}) { // the chamfer between faces `axis` and `u`, along v
                glm::vec3 low(0), high(0);
                low[axis] = high[axis] = side;
                low[u] = high[u] = other;
                low[v] = -1;
                high[v] = 1;
                const std::array<glm::vec3, 4> edge{corner(axis, low), corner(axis, high), corner(u, high),
                                                    corner(u, low)};
                addPolygon(mesh, edge, 0.5f * (low + high));
            }
        }
    }
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        const std::array<glm::vec3, 3> tip{corner(0, signs), corner(1, signs), corner(2, signs)};
        addPolygon(mesh, tip, signs);
    }
    return mesh;
}

Mesh makeGround(float halfSize) {
    Mesh mesh;
    mesh.name = "ground";
    const std::array<glm::vec3, 4> square{glm::vec3(-halfSize, 0, -halfSize), glm::vec3(-halfSize, 0, halfSize),
                                          glm::vec3(halfSize, 0, halfSize), glm::vec3(halfSize, 0, -halfSize)};
    addPolygon(mesh, square, {0, 1, 0});
    return mesh;
}

Mesh makePot(float height) {
    // Radius and height of the outline from the middle of the bottom to the middle of the earth.
    constexpr std::array<glm::vec2, 15> outline{{{0.52f, 0},
                                                 {0.56f, 0.01f},
                                                 {0.58f, 0.05f},
                                                 {0.66f, 0.35f},
                                                 {0.74f, 0.70f},
                                                 {0.75f, 0.735f},
                                                 {0.83f, 0.75f},
                                                 {0.85f, 0.78f},
                                                 {0.87f, 0.95f},
                                                 {0.86f, 0.99f},
                                                 {0.83f, 1},
                                                 {0.79f, 0.99f},
                                                 {0.77f, 0.95f},
                                                 {0.76f, 0.86f},
                                                 {0.50f, 0.88f}}};
    constexpr std::uint32_t segments = 64, rows = outline.size();
    Solid solid;
    for (const glm::vec2& point : outline)
        for (std::uint32_t s = 0; s < segments; ++s) {
            const float angle = 2 * pi * float(s) / float(segments);
            solid.positions.push_back(height * glm::vec3(point.x * sine(angle), point.y, point.x * cosine(angle)));
        }
    const auto at = [](std::uint32_t row, std::uint32_t s) { return row * segments + s % segments; };
    for (std::uint32_t s = 0; s < segments; ++s) {
        for (std::uint32_t row = 0; row + 1 < rows; ++row)
            solid.indices.insert(solid.indices.end(), {at(row, s), at(row, s + 1), at(row + 1, s + 1), at(row, s),
                                                       at(row + 1, s + 1), at(row + 1, s)});
        solid.indices.insert(solid.indices.end(), {rows * segments, at(0, s + 1), at(0, s)});
        solid.indices.insert(solid.indices.end(), {rows * segments + 1, at(rows - 1, s), at(rows - 1, s + 1)});
    }
    solid.positions.push_back({0, 0, 0});
    solid.positions.push_back({0, 0.89f * height, 0});
    const std::vector<glm::vec3> normals = smoothNormals(solid);
    Mesh mesh;
    mesh.name = "pot";
    for (std::size_t i = 0; i < solid.positions.size(); ++i)
        mesh.vertices.push_back({solid.positions[i], normals[i], anyTangent(normals[i]), glm::vec2(0)});
    mesh.indices = std::move(solid.indices);
    return mesh;
}

} // namespace nacre::scene::gallery
