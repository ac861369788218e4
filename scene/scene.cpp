#include "scene/scene.hpp"

#include "scene/outline.hpp"

namespace nacre::scene {

Bounds bounds(const Scene& scene) {
    const Outline outline(scene);
    Bounds result;
    bool empty = true;
    for (const Instance& instance : scene.instances) {
        for (const glm::vec3& point : outline.of(instance.mesh)) {
            const glm::vec3 position = placed(instance, point);
            result.low = glm::min(result.low, position);
            result.high = glm::max(result.high, position);
            empty = false;
        }
    }
    if (empty) {
        throw SceneError("the scene '" + scene.name + "' has no triangles");
    }
    return result;
}

std::uint64_t triangleCount(const Scene& scene) {
    std::uint64_t count = 0;
    for (const Instance& instance : scene.instances) {
        count += scene.meshes.at(instance.mesh).indices.size() / 3;
    }
    return count;
}

} // namespace nacre::scene
