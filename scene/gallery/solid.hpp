// Closed triangle meshes and how they come to an exact number of triangles.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace nacre::scene::gallery {

/// A closed, consistently wound triangle mesh: every edge belongs to exactly two triangles. Counter-clockwise from
/// outside; lengths in mm.
struct Solid {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices; ///< three a triangle

    std::size_t triangleCount() const { return indices.size() / 3; }
};

/// Appends `part` to `solid`; the two stay separate components.
void append(Solid& solid, const Solid& part);

/// Moves a point of an edge's middle back onto the surface.
using Projection = std::function<glm::vec3(const glm::vec3&)>;

/// Brings `solid` to exactly `triangles` [even, > 0]: simplifies it when it has more, then splits its longest edges,
/// two triangles more each, until the number is met. Closed stays closed. Throws std::logic_error when the number is
/// odd, which no closed mesh can have.
void fitTriangleCount(Solid& solid, std::size_t triangles, const Projection& project);

/// Unit normals, the triangles' normals weighted by their angle at the vertex.
std::vector<glm::vec3> smoothNormals(const Solid& solid);

} // namespace nacre::scene::gallery
