#include "scene/gallery/bodies.hpp"

namespace nacre::scene::gallery {

Body makeBody(const ImplicitSurface& surface, float cell, std::size_t triangles) {
    Body body;
    body.solid = surface.polygonise(cell);
    fitTriangleCount(body.solid, triangles, [&](const glm::vec3& p) { return surface.project(p); });
    body.normals.reserve(body.solid.positions.size());
    for (const glm::vec3& p : body.solid.positions)
        body.normals.push_back(surface.normal(p, 0.3f));
    return body;
}

} // namespace nacre::scene::gallery
