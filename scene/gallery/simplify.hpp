// Simplification that keeps closed meshes closed.
#pragma once

#include "scene/gallery/solid.hpp"

namespace nacre::scene::gallery {

/// Collapses edges, cheapest quadric error first (Garland and Heckbert 1997), until `triangles` are left or no edge
/// can go. A vertex moves onto one of its neighbours, so all positions stay exact. Every collapse keeps the mesh a
/// closed manifold (link condition, Dey et al. 1999), which meshoptimizer's simplifier does not promise, and removes
/// two triangles, so an even number is met exactly.
void simplify(Solid& solid, std::size_t triangles);

} // namespace nacre::scene::gallery
