// Lengths of a dense medium whose colour a texture has.
#pragma once

#include "scene/gltf/gltf_medium.hpp"

namespace nacre::scene {

struct ScaleTexture {
    Texture texture;   ///< red, linear: share of `largest`
    float largest = 1; ///< Surface::scale
};

/// What multiplies the lengths of the medium's material where a texel of `colors`, times `factor`, is its
/// multiscatterColor: the mean over red, green and blue of d there over d at the medium's own colour, [1e-3, 1e3].
/// Nothing where it is the same everywhere within 1 %.
std::optional<ScaleTexture> makeScaleTexture(const GltfMedium& medium, const glm::vec3& factor, const Texture& colors);

} // namespace nacre::scene
