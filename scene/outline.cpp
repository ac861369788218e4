#include "scene/outline.hpp"

namespace nacre::scene {
namespace {

constexpr std::uint64_t mostVertices = std::uint64_t{1} << 24;

std::uint64_t placedVertices(const Scene& scene) {
    std::uint64_t count = 0;
    for (const Instance& instance : scene.instances) {
        count += scene.meshes.at(instance.mesh).vertices.size();
    }
    return count;
}

std::vector<glm::vec3> vertices(const Mesh& mesh) {
    std::vector<glm::vec3> points;
    points.reserve(mesh.vertices.size());
    for (const Vertex& vertex : mesh.vertices) {
        points.push_back(vertex.position);
    }
    return points;
}

std::vector<glm::vec3> corners(const Mesh& mesh) {
    if (mesh.vertices.size() <= 8) {
        return vertices(mesh);
    }
    Bounds box;
    for (const Vertex& vertex : mesh.vertices) {
        box.low = glm::min(box.low, vertex.position);
        box.high = glm::max(box.high, vertex.position);
    }
    std::vector<glm::vec3> points;
    for (int corner = 0; corner < 8; ++corner) {
        points.emplace_back((corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                            (corner & 4) != 0 ? box.high.z : box.low.z);
    }
    return points;
}

} // namespace

Outline::Outline(const Scene& scene) {
    const bool hasMany = placedVertices(scene) > mostVertices;
    meshes_.reserve(scene.meshes.size());
    for (const Mesh& mesh : scene.meshes) {
        meshes_.push_back(hasMany ? corners(mesh) : vertices(mesh));
    }
}

} // namespace nacre::scene
