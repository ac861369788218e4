#include "scene/primitive_meshes.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace nacre::scene {

namespace {

/// Corners counter-clockwise as seen from the side that the normal points to.
void addQuad(Mesh& mesh, const std::array<glm::vec3, 4>& corners, const glm::vec3& normal) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const glm::vec3& corner : corners) {
        mesh.vertices.push_back({corner, normal, {1, 0, 0, 1}, {0, 0}});
    }
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) {
        mesh.indices.push_back(first + index);
    }
}

} // namespace

Mesh rectangle(const glm::vec2& low, const glm::vec2& high, float y) {
    Mesh mesh;
    mesh.name = "rectangle";
    addQuad(mesh, {{{low.x, y, low.y}, {low.x, y, high.y}, {high.x, y, high.y}, {high.x, y, low.y}}}, {0, 1, 0});
    return mesh;
}

Mesh ring(float innerRadius, float outerRadius, float y, int segments) {
    Mesh mesh;
    mesh.name = "ring";
    for (int i = 0; i < segments; ++i) {
        const double from = 2 * std::numbers::pi * i / segments;
        const double to = 2 * std::numbers::pi * (i + 1) / segments;
        const auto at = [&](double angle, float radius) {
            return glm::vec3(radius * std::cos(angle), y, -radius * std::sin(angle));
        };
        addQuad(mesh, {{at(from, innerRadius), at(from, outerRadius), at(to, outerRadius), at(to, innerRadius)}},
                {0, 1, 0});
    }
    return mesh;
}

Mesh box(const glm::vec3& low, const glm::vec3& high) {
    Mesh mesh;
    mesh.name = "box";
    for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) {
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            std::array<glm::vec3, 4> corners{};
            for (int i = 0; i < 4; ++i) {
                corners[i][axis] = side == 1 ? high[axis] : low[axis];
                corners[i][u] = i == 1 || i == 2 ? high[u] : low[u];
                corners[i][v] = i >= 2 ? high[v] : low[v];
            }
            if (side == 0) {
                std::swap(corners[1], corners[3]);
            }
            glm::vec3 normal(0);
            normal[axis] = side == 1 ? 1.0f : -1.0f;
            addQuad(mesh, corners, normal);
        }
    }
    return mesh;
}

Mesh ball(float radius, int rings) {
    Mesh mesh;
    mesh.name = "ball";
    const int segments = 2 * rings;
    for (int ring = 0; ring <= rings; ++ring) {
        const double polar = std::numbers::pi * ring / rings;
        const double sine = ring == 0 || ring == rings ? 0 : std::sin(polar);
        for (int i = 0; i < segments; ++i) {
            const double azimuth = 2 * std::numbers::pi * i / segments;
            const glm::vec3 normal(sine * std::cos(azimuth), std::cos(polar), -sine * std::sin(azimuth));
            mesh.vertices.push_back({radius * normal, normal, {1, 0, 0, 1}, {0, 0}});
        }
    }
    const auto vertex = [&](int ring, int i) { return static_cast<std::uint32_t>(ring * segments + i % segments); };
    for (int ring = 0; ring < rings; ++ring) {
        for (int i = 0; i < segments; ++i) {
            if (ring > 0) {
                mesh.indices.insert(mesh.indices.end(), {vertex(ring, i), vertex(ring + 1, i), vertex(ring, i + 1)});
            }
            if (ring + 1 < rings) {
                mesh.indices.insert(mesh.indices.end(),
                                    {vertex(ring, i + 1), vertex(ring + 1, i), vertex(ring + 1, i + 1)});
            }
        }
    }
    return mesh;
}

} // namespace nacre::scene
