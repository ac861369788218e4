// What the bodies stand on. Metres.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene::gallery {

/// A box with chamfered edges and flat faces: 44 triangles.
Mesh makeChamferedBox(const glm::vec3& halfSize, float chamfer);

/// A flat square in y = 0: two triangles.
Mesh makeGround(float halfSize);

/// A flower pot on y = 0, `height` m tall: a closed surface of revolution.
Mesh makePot(float height);

/// A unit vector at right angles to the normal, as a tangent for meshes without texture coordinates.
glm::vec4 anyTangent(const glm::vec3& normal);

} // namespace nacre::scene::gallery
