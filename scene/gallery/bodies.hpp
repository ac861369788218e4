// The gallery's five bodies, each a closed mesh with exactly the number of triangles asked for [even]. Millimetres;
// +Y up, facing +Z, standing on y = 0 around the origin.
#pragma once

#include "scene/gallery/implicit_surface.hpp"

#include <span>

namespace nacre::scene::gallery {

struct Body {
    Solid solid;
    std::vector<glm::vec3> normals; ///< unit, one a vertex
};

/// A bust, 306 mm tall, with closed eyes and ears 2 mm thin.
Body makeHead(std::size_t triangles);
/// The same bust with open eyes, for balls of 12 mm around (±32, 115, 73); its skin is smooth.
Body makeOpenEyedHead(std::size_t triangles);
/// A crouching dragon, wings spread; membranes and fins 2 to 3 mm thin.
Body makeDragon(std::size_t triangles);
/// The word NACRE, extruded and bevelled.
Body makeLogo(std::size_t triangles);
/// A nautilus shell with a wall of 2 mm, its axis along z.
Body makeShell(std::size_t triangles);
/// Broad leaves of 0.4 mm, thicker along their veins, on stems.
Body makePlant(std::size_t triangles);

/// Texture coordinates of a point of the head [mm]: the direction from the middle of the head, azimuthal equidistant
/// about +Z. Without a seam; stretched at the back of the head only.
glm::vec2 headTextureCoordinates(const glm::vec3& p);
/// The head's albedo: lips, cheeks, brows, lashes, a shaved scalp.
Texture makeSkinTexture();
/// Linear albedos at points of the open-eyed head [mm]: the head's, without brows and lashes.
std::vector<glm::vec3> openEyedHeadColors(std::span<const glm::vec3> positions);

/// Texture coordinates of a point of the shell [mm]: seen along its axis.
glm::vec2 shellTextureCoordinates(const glm::vec3& p);
/// The shell's albedo: mother-of-pearl with brown flames.
Texture makeShellTexture();

/// Polygonises on a grid of `cell` mm, comes to the number of triangles and takes the normals from the gradient.
Body makeBody(const ImplicitSurface& surface, float cell, std::size_t triangles);

} // namespace nacre::scene::gallery
