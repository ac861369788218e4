// Baked thickness on disk: pictures of a texture, and meshes with a value a vertex. Files appear complete or not at
// all.
#pragma once

#include "bake/atlas.hpp"

#include <filesystem>

namespace nacre::bake {

/// An OpenEXR file: MM, the thickness in millimetres, padded, and A, 1 where the surface is and 0 in the padding.
void writeThicknessExr(const std::filesystem::path& file, const Atlas& atlas, std::span<const float> millimetres);

/// An 8-bit grey PNG, padded: thickness / white, rounded, cut off at 1. white [> 0] mm is what glTF calls
/// thicknessFactor, in metres there.
void writeThicknessPng(const std::filesystem::path& file, const Atlas& atlas, std::span<const float> millimetres,
                       double white);

/// A binary PLY file of the meshes as the scene places them, in scene units: x y z, nx ny nz and `thickness` in mm for
/// each vertex, and the triangles. Vertices without a triangle are left out.
void writeThicknessPly(const std::filesystem::path& file, const scene::Scene& scene, const VertexPlaces& vertices,
                       std::span<const float> millimetres);

} // namespace nacre::bake
