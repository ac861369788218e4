// What a scene reaches to, for scenes that place a mesh many times.
#pragma once

#include "scene/scene.hpp"

#include <span>

namespace nacre::scene {

/// Points of each mesh whose hull holds the mesh: its vertices. Where the instances have more than 2^24 vertices
/// together, the eight corners of each mesh's box stand in for them, so that what all instances reach to takes time and
/// memory in proportion to their number; bounds are then a little wide.
class Outline {
public:
    explicit Outline(const Scene& scene);

    std::span<const glm::vec3> of(std::uint32_t mesh) const { return meshes_.at(mesh); }

private:
    std::vector<std::vector<glm::vec3>> meshes_;
};

/// `point` of an instance's mesh, in scene units.
inline glm::vec3 placed(const Instance& instance, const glm::vec3& point) {
    return glm::vec3(instance.transform * glm::vec4(point, 1));
}

} // namespace nacre::scene
