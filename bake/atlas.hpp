// Which point of a surface each texel of its texture shows.
#pragma once

#include "trace/geometry.hpp"

#include <span>
#include <vector>

namespace nacre::bake {

/// The texels of a picture that a surface's texture coordinates cover, and where on the surface they lie.
struct Atlas {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint32_t> texels; ///< row by row, growing
    std::vector<trace::Hit> places;    ///< of `texels`; the distance is 0
    std::uint64_t shared = 0;          ///< texels whose middle lies in triangles at several places
};

/// Texels whose middle lies in a triangle show that point; where several do, the first triangle's. Texels that a
/// triangle only touches show its nearest point. The picture repeats: coordinates outside of [0, 1] come round again. A
/// mesh that the scene has several times counts where it is first. Throws SceneError, beginning with `where`, when a
/// triangle covers the picture more than 16 times over in one direction. Empty when the surface has no texture
/// coordinates.
Atlas makeAtlas(const scene::Scene& scene, std::uint32_t surface, std::uint32_t width, std::uint32_t height,
                const std::string& where);

/// A point near each vertex of the surface's meshes: 1/64 of the way to the middle of its first triangle, so that it is
/// on one side of an edge. In the order of the instances; vertices without a triangle have none.
struct VertexPlaces {
    std::vector<trace::Hit> places;
    std::vector<std::uint32_t> instances; ///< those that were visited
    /// Per instance visited and vertex of its mesh: the index into `places`, or scene::none.
    std::vector<std::vector<std::uint32_t>> indices;
};

/// surface: an index, or scene::none for all surfaces.
VertexPlaces makeVertexPlaces(const scene::Scene& scene, std::uint32_t surface);

/// A whole picture: `values` at the atlas's texels, and everywhere else the value of the texel that is nearest in steps
/// from neighbour to neighbour, so that no filter and no mip level mixes a seam with what is not there.
std::vector<float> padded(const Atlas& atlas, std::span<const float> values);

} // namespace nacre::bake
