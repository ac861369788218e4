// The gallery's five bodies, each a closed mesh with exactly the number of triangles asked for [even]. Millimetres;
// +Y up, facing +Z, standing on y = 0 around the origin.
#pragma once

#include "scene/gallery/implicit_surface.hpp"

namespace nacre::scene::gallery {

struct Body {
    Solid solid;
    std::vector<glm::vec3> normals; ///< unit, one a vertex
};

/// A bust, 310 mm tall, with closed eyes and ears of 3 mm.
Body makeHead(std::size_t triangles);
/// A crouching dragon, wings spread; membranes and fins of 2 to 3 mm.
Body makeDragon(std::size_t triangles);
/// The word NACRE, extruded and bevelled.
Body makeLogo(std::size_t triangles);
/// A nautilus shell with a wall of 2 mm.
Body makeShell(std::size_t triangles);
/// Broad leaves of 0.8 mm on stems.
Body makePlant(std::size_t triangles);

/// Polygonises on a grid of `cell` mm, comes to the number of triangles and takes the normals from the gradient.
Body makeBody(const ImplicitSurface& surface, float cell, std::size_t triangles);

} // namespace nacre::scene::gallery
