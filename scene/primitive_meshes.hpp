// Meshes of a few parameters, in scene units, without texture coordinates: what references and pictures are compared
// on.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// The rectangle from low to high in x and z at height y, facing up.
Mesh rectangle(const glm::vec2& low, const glm::vec2& high, float y);
/// A flat ring about the y axis at height y, facing up.
Mesh ring(float innerRadius, float outerRadius, float y, int segments = 256);
/// A closed box, faces outwards.
Mesh box(const glm::vec3& low, const glm::vec3& high);
/// A closed ball of triangles with smooth normals, its vertices on the sphere.
Mesh ball(float radius, int rings = 96);

} // namespace nacre::scene
