#include "scene/import_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <meshoptimizer.h>
#include <numeric>

namespace nacre::scene {
namespace {

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The unit vector, or zero where there is no direction.
glm::vec3 directionOf(const glm::vec3& v) {
    const float length = glm::length(v);
    return std::isfinite(length) && length > 0 ? v / length : glm::vec3(0);
}

/// Corner positions of triangle `face`.
std::array<glm::vec3, 3> corners(const Mesh& mesh, std::size_t face) {
    const auto position = [&](std::size_t corner) { return mesh.vertices[mesh.indices[face * 3 + corner]].position; };
    return {position(0), position(1), position(2)};
}

glm::vec3 faceNormal(const std::array<glm::vec3, 3>& p) {
    return directionOf(glm::cross(directionOf(p[1] - p[0]), directionOf(p[2] - p[0])));
}

float cornerAngle(const std::array<glm::vec3, 3>& p, std::size_t corner) {
    const glm::vec3 a = directionOf(p[(corner + 1) % 3] - p[corner]);
    const glm::vec3 b = directionOf(p[(corner + 2) % 3] - p[corner]);
    return std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
}

/// A unit vector at right angles to a unit vector (Duff et al. 2017, "Building an orthonormal basis, revisited").
glm::vec3 perpendicular(const glm::vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

/// Gives every corner of every triangle a vertex of its own.
void unshareVertices(Mesh& mesh) {
    std::vector<Vertex> vertices(mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        vertices[i] = mesh.vertices[mesh.indices[i]];
    }
    mesh.vertices = std::move(vertices);
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
}

/// For each vertex the number of its position; equal positions have equal numbers.
std::vector<std::uint32_t> numberPositions(const Mesh& mesh, std::size_t& positionCount) {
    std::vector<glm::vec3> positions(mesh.vertices.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        positions[i] = mesh.vertices[i].position + 0.0f; // -0 becomes 0: bytes are compared
    }
    std::vector<std::uint32_t> numbers(positions.size());
    positionCount = meshopt_generateVertexRemap(numbers.data(), nullptr, positions.size(), positions.data(),
                                                positions.size(), sizeof(glm::vec3));
    return numbers;
}

} // namespace

std::vector<std::uint32_t> triangleList(PrimitiveMode mode, std::span<const std::uint32_t> indices) {
    std::vector<std::uint32_t> result;
    const std::size_t count = indices.size();
    const auto append = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && b != c && c != a) {
            result.insert(result.end(), {a, b, c});
        }
    };
    switch (mode) {
    case PrimitiveMode::Triangles:
        result.assign(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(count - count % 3));
        break;
    case PrimitiveMode::TriangleStrip:
        for (std::size_t i = 2; i < count; ++i) {
            append(indices[i - 2], indices[i - 1 + i % 2], indices[i - i % 2]);
        }
        break;
    case PrimitiveMode::TriangleFan:
        for (std::size_t i = 2; i < count; ++i) {
            append(indices[0], indices[i - 1], indices[i]);
        }
        break;
    default:
        break;
    }
    return result;
}

void checkMesh(Mesh& mesh, const std::string& where) {
    for (const std::uint32_t index : mesh.indices) {
        if (index >= mesh.vertices.size()) {
            throw SceneError(where + " has the vertex index " + std::to_string(index) + ", but only " +
                             std::to_string(mesh.vertices.size()) + " vertices");
        }
    }
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        Vertex& vertex = mesh.vertices[i];
        const glm::vec3 size = glm::abs(vertex.position);
        if (!(std::max({size.x, size.y, size.z}) <= maxCoordinate) || !isFinite(vertex.position)) {
            throw SceneError(where + ": the position of vertex " + std::to_string(i) + " is (" +
                             std::to_string(vertex.position.x) + ", " + std::to_string(vertex.position.y) + ", " +
                             std::to_string(vertex.position.z) + "), must be finite and below 1e15");
        }
        for (glm::vec2* uv : {&vertex.uv, &vertex.secondUv}) {
            if (!std::isfinite(uv->x) || !std::isfinite(uv->y)) {
                *uv = glm::vec2(0);
            }
        }
    }
}

glm::vec<4, std::uint16_t> vertexColor(const glm::vec4& color) {
    glm::vec<4, std::uint16_t> result;
    for (int i = 0; i < 4; ++i) {
        result[i] = static_cast<std::uint16_t>(color[i] > 0 ? std::lround(std::min(color[i], 1.0f) * 65535) : 0);
    }
    return result;
}

void weldVertices(Mesh& mesh) {
    if (mesh.indices.empty()) {
        mesh.vertices.clear();
        return;
    }
    std::vector<std::uint32_t> remap(mesh.vertices.size());
    const std::size_t count = meshopt_generateVertexRemap(remap.data(), mesh.indices.data(), mesh.indices.size(),
                                                          mesh.vertices.data(), mesh.vertices.size(), sizeof(Vertex));
    std::vector<Vertex> vertices(count);
    meshopt_remapVertexBuffer(vertices.data(), mesh.vertices.data(), mesh.vertices.size(), sizeof(Vertex),
                              remap.data());
    meshopt_remapIndexBuffer(mesh.indices.data(), mesh.indices.data(), mesh.indices.size(), remap.data());
    mesh.vertices = std::move(vertices);
}

void makeFlatNormals(Mesh& mesh) {
    unshareVertices(mesh);
    for (std::size_t face = 0; face < mesh.indices.size() / 3; ++face) {
        const glm::vec3 normal = faceNormal(corners(mesh, face));
        for (std::size_t corner = 0; corner < 3; ++corner) {
            mesh.vertices[face * 3 + corner].normal = normal;
        }
    }
    weldVertices(mesh);
}

void makeSmoothNormals(Mesh& mesh, float limit) {
    if (mesh.indices.empty()) {
        return;
    }
    // Beyond this many faces around one position (none in a real model) the crease angle is not looked at: comparing
    // every face with every other would take forever.
    constexpr std::size_t maxFacesCompared = 512;

    unshareVertices(mesh);
    std::size_t positionCount = 0;
    const std::vector<std::uint32_t> positionOf = numberPositions(mesh, positionCount);
    const std::size_t cornerCount = mesh.indices.size();
    std::vector<glm::vec3> faceNormals(cornerCount / 3);
    std::vector<glm::vec3> weighted(cornerCount);
    std::vector<std::uint32_t> first(positionCount + 1); // corners sorted by position
    for (std::size_t corner = 0; corner < cornerCount; ++corner) {
        const auto p = corners(mesh, corner / 3);
        if (corner % 3 == 0) {
            faceNormals[corner / 3] = faceNormal(p);
        }
        weighted[corner] = faceNormals[corner / 3] * cornerAngle(p, corner % 3);
        ++first[positionOf[corner] + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> sorted(cornerCount);
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t corner = 0; corner < cornerCount; ++corner) {
        sorted[next[positionOf[corner]]++] = corner;
    }

    const float cosine = std::cos(limit);
    for (std::size_t position = 0; position < positionCount; ++position) {
        const std::span around(sorted.data() + first[position], first[position + 1] - first[position]);
        const bool compared = around.size() <= maxFacesCompared;
        glm::vec3 all(0);
        for (const std::uint32_t corner : around) {
            all += weighted[corner];
        }
        for (const std::uint32_t corner : around) {
            glm::vec3 sum = compared ? glm::vec3(0) : all;
            for (std::size_t i = 0; compared && i < around.size(); ++i) {
                if (glm::dot(faceNormals[corner / 3], faceNormals[around[i] / 3]) >= cosine) {
                    sum += weighted[around[i]];
                }
            }
            const glm::vec3 normal = directionOf(sum);
            mesh.vertices[corner].normal = normal != glm::vec3(0) ? normal : directionOf(all);
        }
    }
    repairNormals(mesh);
    weldVertices(mesh);
}

void repairNormals(Mesh& mesh) {
    std::vector<glm::vec3> fromFaces;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        Vertex& vertex = mesh.vertices[i];
        vertex.normal = directionOf(vertex.normal);
        if (vertex.normal == glm::vec3(0)) {
            if (fromFaces.empty()) {
                fromFaces.resize(mesh.vertices.size());
                for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
                    fromFaces[mesh.indices[corner]] += faceNormal(corners(mesh, corner / 3));
                }
            }
            vertex.normal = directionOf(fromFaces[i]);
        }
        if (vertex.normal == glm::vec3(0)) {
            vertex.normal = glm::vec3(0, 1, 0); // belongs to degenerate triangles only, which are never seen
        }
        const glm::vec3 tangent = directionOf(glm::vec3(vertex.tangent));
        vertex.tangent = glm::vec4(tangent != glm::vec3(0) ? tangent : perpendicular(vertex.normal),
                                   vertex.tangent.w < 0 ? -1.0f : 1.0f);
    }
}

void makeTangents(Mesh& mesh, const TextureCoordinates& coordinates) {
    struct Sides {
        std::array<glm::vec3, 2> sum{glm::vec3(0), glm::vec3(0)}; // of faces whose image is upright, mirrored
        std::array<bool, 2> used{};
    };
    std::vector<Sides> sides(mesh.vertices.size());
    std::vector<bool> mirroredFace(mesh.indices.size() / 3);
    for (std::size_t face = 0; face < mesh.indices.size() / 3; ++face) {
        const std::uint32_t* index = &mesh.indices[face * 3];
        const auto uv = [&](std::size_t corner) {
            return glm::vec2(coordinates.transform * glm::vec3(coordinates.of(mesh.vertices[index[corner]]), 1));
        };
        const auto p = corners(mesh, face);
        const glm::vec2 a = uv(1) - uv(0);
        const glm::vec2 b = uv(2) - uv(0);
        const float area = a.x * b.y - a.y * b.x;
        const glm::vec3 tangent = directionOf((p[1] - p[0]) * b.y - (p[2] - p[0]) * a.y) * (area < 0 ? -1.0f : 1.0f);
        if (area == 0 || tangent == glm::vec3(0)) {
            continue;
        }
        mirroredFace[face] = area > 0; // v grows downwards
        for (std::size_t corner = 0; corner < 3; ++corner) {
            Sides& side = sides[index[corner]];
            const glm::vec3& n = mesh.vertices[index[corner]].normal;
            side.sum[mirroredFace[face]] += directionOf(tangent - n * glm::dot(n, tangent)) * cornerAngle(p, corner);
            side.used[mirroredFace[face]] = true;
        }
    }

    std::vector<std::uint32_t> mirroredTwin(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto tangentOf = [&](std::size_t side) {
            const glm::vec3 tangent = directionOf(sides[i].sum[side]);
            return glm::vec4(tangent != glm::vec3(0) ? tangent : perpendicular(mesh.vertices[i].normal),
                             side == 0 ? 1.0f : -1.0f);
        };
        const bool onlyMirrored = sides[i].used[1] && !sides[i].used[0];
        mesh.vertices[i].tangent = tangentOf(onlyMirrored ? 1 : 0);
        mirroredTwin[i] = static_cast<std::uint32_t>(i);
        if (sides[i].used[0] && sides[i].used[1]) {
            mirroredTwin[i] = static_cast<std::uint32_t>(mesh.vertices.size());
            Vertex twin = mesh.vertices[i];
            twin.tangent = tangentOf(1);
            mesh.vertices.push_back(twin);
        }
    }
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        if (mirroredFace[corner / 3]) {
            mesh.indices[corner] = mirroredTwin[mesh.indices[corner]];
        }
    }
}

} // namespace nacre::scene
