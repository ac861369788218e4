// Morph targets and skins of glTF primitives.
#pragma once

#include "scene/gltf/gltf_mesh.hpp"

namespace nacre::scene {

/// Adds the morph targets with the given weights to positions, normals, tangents, texture coordinates and colours.
void applyMorphTargets(const GltfFile& file, int mesh, std::size_t primitive, std::span<const double> weights,
                       GltfPrimitive& target);

/// Moves positions, normals and tangents by the joints of a skin, whose nodes are at `nodeTransforms`. All sets
/// JOINTS_n and WEIGHTS_n count; weights are divided by their sum over all sets, and a vertex without weights stays
/// where it is. Throws SceneError where a set is missing below another, or has only one of the two attributes.
void applySkin(const GltfFile& file, int skin, std::span<const glm::mat4> nodeTransforms, GltfPrimitive& target);

} // namespace nacre::scene
