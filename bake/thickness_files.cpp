#include "bake/thickness_files.hpp"

#include "image/image_file.hpp"
#include "nacre/files.hpp"

#include <array>
#include <bit>

namespace nacre::bake {
namespace {

static_assert(std::endian::native == std::endian::little, "the PLY file says so");

using PlyVertex = std::array<float, 7>;

template <typename Value> void append(std::vector<std::uint8_t>& bytes, const Value& value) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(Value));
}

std::string plyHeader(std::size_t vertices, std::size_t faces) {
    std::string header = "ply\nformat binary_little_endian 1.0\ncomment thickness is in millimetres\nelement vertex " +
                         std::to_string(vertices) + '\n';
    for (const char* property : {"x", "y", "z", "nx", "ny", "nz", "thickness"}) {
        header += std::string("property float ") + property + '\n';
    }
    return header + "element face " + std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

/// One instance's vertices and triangles, those by their numbers in the whole file.
void appendInstance(const scene::Instance& instance, const scene::Mesh& mesh, std::span<const std::uint32_t> numbers,
                    std::span<const float> millimetres, std::vector<PlyVertex>& vertices,
                    std::vector<std::uint8_t>& faces) {
    const glm::mat3 linear(instance.transform);
    const bool mirrored = glm::determinant(linear) < 0;
    const glm::mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (numbers[i] == scene::none) {
            continue;
        }
        const glm::vec3 position(instance.transform * glm::vec4(mesh.vertices[i].position, 1));
        const glm::vec3 normal = glm::normalize((mirrored ? -1.0f : 1.0f) * (cofactors * mesh.vertices[i].normal));
        vertices[numbers[i]] = {
            position.x, position.y, position.z, normal.x, normal.y, normal.z, millimetres[numbers[i]]};
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        append(faces, std::uint8_t{3});
        const std::array<std::size_t, 3> order{i, mirrored ? i + 2 : i + 1, mirrored ? i + 1 : i + 2};
        for (const std::size_t corner : order) {
            append(faces, static_cast<std::int32_t>(numbers[mesh.indices[corner]]));
        }
    }
}

} // namespace

void writeThicknessExr(const std::filesystem::path& file, const Atlas& atlas, std::span<const float> millimetres) {
    const std::vector<float> picture = padded(atlas, millimetres);
    nacre::Image image = makeImage(atlas.width, atlas.height, {"MM", "A"});
    for (std::size_t i = 0; i < picture.size(); ++i) {
        image.values[2 * i] = picture[i];
    }
    for (const std::uint32_t texel : atlas.texels) {
        image.values[2 * std::size_t{texel} + 1] = 1;
    }
    writeExr(file, image);
}

void writeThicknessPng(const std::filesystem::path& file, const Atlas& atlas, std::span<const float> millimetres,
                       double white) {
    // Values of a display's encoding are written as they are.
    nacre::Image image = makeImage(atlas.width, atlas.height, {"Y"}, Encoding::Srgb);
    image.values = padded(atlas, millimetres);
    for (float& value : image.values) {
        value = static_cast<float>(value / white);
    }
    writePng(file, image);
}

void writeThicknessPly(const std::filesystem::path& file, const scene::Scene& scene, const VertexPlaces& vertices,
                       std::span<const float> millimetres) {
    std::vector<PlyVertex> values(vertices.places.size());
    std::vector<std::uint8_t> faces;
    std::size_t faceCount = 0;
    for (std::size_t i = 0; i < vertices.instances.size(); ++i) {
        const scene::Instance& instance = scene.instances[vertices.instances[i]];
        const scene::Mesh& mesh = scene.meshes[instance.mesh];
        appendInstance(instance, mesh, vertices.indices[i], millimetres, values, faces);
        faceCount += mesh.indices.size() / 3;
    }
    const std::string header = plyHeader(values.size(), faceCount);
    std::vector<std::uint8_t> bytes(header.begin(), header.end());
    for (const PlyVertex& vertex : values) {
        for (const float value : vertex) {
            append(bytes, value);
        }
    }
    bytes.insert(bytes.end(), faces.begin(), faces.end());
    writeFileAtomically(file, bytes);
}

} // namespace nacre::bake
