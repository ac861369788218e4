// What every importer does to a mesh once its vertices are read: checks, normals, tangents.
#pragma once

#include "scene/scene.hpp"

#include <span>
#include <string>

namespace nacre::scene {

/// [rad] Faces that meet at a sharper angle than this keep an edge when normals are computed: 60°, which keeps the
/// edges of boxes and chamfered parts and smooths scans and coarse cylinders.
inline constexpr float creaseAngle = 1.0471976f;

/// Largest coordinate that is accepted, in either direction: beyond it, squared lengths leave the range of a float.
inline constexpr float maxCoordinate = 1e15f;

/// Meshes that one file places: more is an attack or an accident.
inline constexpr std::size_t maxInstances = std::size_t{1} << 20;

/// How the indices of a primitive make triangles (the values are glTF's).
enum class PrimitiveMode {
    Points = 0,
    Lines = 1,
    LineLoop = 2,
    LineStrip = 3,
    Triangles = 4,
    TriangleStrip = 5,
    TriangleFan = 6
};

/// Indices as a triangle list: strips and fans are unrolled without their degenerate triangles, an incomplete last
/// triangle is dropped, points and lines give nothing.
std::vector<std::uint32_t> triangleList(PrimitiveMode mode, std::span<const std::uint32_t> indices);

/// Throws SceneError, beginning with `where`, for an index out of range and for positions that are not finite or beyond
/// `maxCoordinate`; texture coordinates that are not finite become 0.
void checkMesh(Mesh& mesh, const std::string& where);

/// A linear colour as vertices have it: cut off at 0 and 1, what is not a number is 0.
glm::vec<4, std::uint16_t> vertexColor(const glm::vec4& color);

/// Merges vertices that are equal in every member.
void weldVertices(Mesh& mesh);

/// One normal a face, as glTF asks for when a primitive brings none.
void makeFlatNormals(Mesh& mesh);

/// Normals averaged over the faces around a position, weighted by the angle they have there, separately for faces that
/// meet at more than `limit`. Vertices are merged by position first and split again where they need to be.
void makeSmoothNormals(Mesh& mesh, float limit = creaseAngle);

/// Normalises normals and tangents, and replaces normals that are zero or not finite by those of the faces around them.
void repairNormals(Mesh& mesh);

/// Tangents along the growing u of these coordinates (Lengyel 2001, weighted by angle); w such that cross(normal,
/// tangent)·w points up in the image. Vertices between mirrored halves are split; without usable uv any tangent will
/// do.
void makeTangents(Mesh& mesh, const TextureCoordinates& coordinates);

} // namespace nacre::scene
