// What turns a light's hardware depth into lengths again.
#pragma once

#include "interface/glsl_types.h"
#include "nacre/nacre.h"

#include <array>

namespace nacre::effect {

/// A matrix from (texel, stored depth, 1) to homogeneous offsets from a point of the world, both in the shaders' order.
struct ShadowDecoding {
    mat4 offsetFromTexel{};
    bool isValid = false; ///< the matrix of the map can be inverted
};

/// Of a map of this many texels, drawn with a matrix from the world to clip space.
ShadowDecoding decodingOf(const float (&clipFromWorld)[16], const std::array<double, 3>& origin, VkExtent2D size);
/// Of the faces of a cube, whose offsets have the right length alone. projection: a face's.
ShadowDecoding cubeDecodingOf(const float (&projection)[16], VkExtent2D size);
/// The point of the world in the middle of clip space where depth is 0; not finite where
/// the matrix cannot be inverted.
std::array<double, 3> middleOfMap(const float (&clipFromWorld)[16]);

} // namespace nacre::effect
