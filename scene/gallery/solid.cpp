#include "scene/gallery/solid.hpp"

#include "scene/gallery/portable_math.hpp"
#include "scene/gallery/simplify.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <tuple>

namespace nacre::scene::gallery {

namespace {

/// One triangle's side of an edge; `corner` is the edge's first corner in it.
struct HalfEdge {
    std::uint32_t low, high;
    std::uint32_t triangle;
    std::uint32_t corner;
};

/// The two sides of every edge stand next to each other.
std::vector<HalfEdge> pairedHalfEdges(const Solid& solid) {
    std::vector<HalfEdge> sides;
    sides.reserve(solid.indices.size());
    for (std::uint32_t t = 0; t < solid.triangleCount(); ++t)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t a = solid.indices[3 * t + c], b = solid.indices[3 * t + (c + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), t, c});
        }
    std::sort(sides.begin(), sides.end(), [](const HalfEdge& l, const HalfEdge& r) {
        return std::tie(l.low, l.high, l.triangle) < std::tie(r.low, r.high, r.triangle);
    });
    return sides;
}

void splitSide(Solid& solid, const HalfEdge& side, std::uint32_t middle) {
    std::uint32_t* corners = &solid.indices[3 * side.triangle];
    const std::uint32_t end = corners[(side.corner + 1) % 3], opposite = corners[(side.corner + 2) % 3];
    corners[(side.corner + 1) % 3] = middle;
    solid.indices.insert(solid.indices.end(), {middle, end, opposite});
}

/// Splits the longest edges that share no triangle, at most `edges` of them; says how many.
std::size_t splitLongestEdges(Solid& solid, std::size_t edges, const Projection& project) {
    const std::vector<HalfEdge> sides = pairedHalfEdges(solid);
    std::vector<std::pair<float, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < sides.size(); i += 2) {
        const glm::vec3 d = solid.positions[sides[i].high] - solid.positions[sides[i].low];
        order.emplace_back(-glm::dot(d, d), i);
    }
    std::sort(order.begin(), order.end());
    order.resize(std::min(order.size(), std::max<std::size_t>(64, order.size() / 8))); // the long ones only
    std::vector<bool> touched(solid.triangleCount(), false);
    std::size_t done = 0;
    for (const auto& [length, i] : order) {
        if (done == edges)
            break;
        const HalfEdge first = sides[i], second = sides[i + 1];
        if (touched[first.triangle] || touched[second.triangle])
            continue;
        touched[first.triangle] = touched[second.triangle] = true;
        const auto middle = std::uint32_t(solid.positions.size());
        solid.positions.push_back(project(0.5f * (solid.positions[first.low] + solid.positions[first.high])));
        splitSide(solid, first, middle);
        splitSide(solid, second, middle);
        ++done;
    }
    return done;
}

} // namespace

void append(Solid& solid, const Solid& part) {
    const auto base = std::uint32_t(solid.positions.size());
    solid.positions.insert(solid.positions.end(), part.positions.begin(), part.positions.end());
    for (const std::uint32_t index : part.indices)
        solid.indices.push_back(base + index);
}

void fitTriangleCount(Solid& solid, std::size_t triangles, const Projection& project) {
    if (triangles % 2 != 0 || solid.triangleCount() % 2 != 0)
        throw std::logic_error("a closed mesh has an even number of triangles");
    if (solid.triangleCount() > triangles)
        simplify(solid, triangles);
    while (solid.triangleCount() < triangles)
        splitLongestEdges(solid, (triangles - solid.triangleCount()) / 2, project);
}

std::vector<glm::vec3> smoothNormals(const Solid& solid) {
    std::vector<glm::vec3> normals(solid.positions.size(), glm::vec3(0));
    for (std::size_t i = 0; i < solid.indices.size(); i += 3) {
        const std::array<glm::vec3, 3> p{solid.positions[solid.indices[i]], solid.positions[solid.indices[i + 1]],
                                         solid.positions[solid.indices[i + 2]]};
        const glm::vec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
        for (int c = 0; c < 3; ++c) {
            const glm::vec3 a = p[(c + 1) % 3] - p[c], b = p[(c + 2) % 3] - p[c];
            normals[solid.indices[i + c]] += arcTangent(glm::length(glm::cross(a, b)), glm::dot(a, b)) * normal;
        }
    }
    for (glm::vec3& normal : normals)
        normal = glm::normalize(normal);
    return normals;
}

} // namespace nacre::scene::gallery
