#include "trace/area.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::trace {

AreaSampler::AreaSampler(const Geometry& geometry, std::span<const std::uint32_t> instances) {
    const scene::Scene& scene = geometry.scene();
    double sum = 0;
    for (const std::uint32_t instance : instances) {
        const std::size_t count = scene.meshes[scene.instances[instance].mesh].indices.size() / 3;
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto [a, b, c] = geometry.corners(instance, i);
            const double area = 0.5 * glm::length(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a)));
            if (area > 0) {
                sum += area;
                triangles_.push_back({instance, i});
                cumulative_.push_back(sum);
            }
        }
    }
}

Hit AreaSampler::sample(Random& random) const {
    const double target = random.uniform() * area();
    const auto found = std::ranges::upper_bound(cumulative_, target);
    const std::size_t index = std::min(static_cast<std::size_t>(found - cumulative_.begin()), triangles_.size() - 1);
    // Turk 1990, "Generating random points in triangles".
    const double root = std::sqrt(random.uniform());
    const double v = random.uniform() * root;
    return {0, triangles_[index].instance, triangles_[index].index, static_cast<float>(root - v),
            static_cast<float>(v)};
}

} // namespace nacre::trace
