// Points in clusters: how far they reach along an axis, or from a place, without a look at every one. Internal to the
// renderer.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace nacre::renderer {

struct Interval {
    float low;
    float high;
    float length() const { return high - low; }
    float center() const { return 0.5f * (low + high); }
};

/// Lights that move ask for these numbers many times a frame, of all vertices of a scene.
class PointClusters {
public:
    PointClusters() = default;
    explicit PointClusters(std::vector<glm::vec3> points);
    PointClusters(PointClusters&&) = default;
    PointClusters& operator=(PointClusters&&) = default;

    /// All of them, in an order of their own.
    std::span<const glm::vec3> points() const { return points_; }
    /// What `interval` holds and the points along `axis`, to the last bit as if all of them were looked at.
    Interval extend(const Interval& interval, const glm::vec3& axis) const;
    /// The larger of `distance` and that of the point farthest from `place`.
    float farthest(float distance, const glm::vec3& place) const;

private:
    struct Cluster {
        std::span<const glm::vec3> points;
        glm::vec3 center;
        glm::vec3 half; ///< of the box around them
    };

    void split(std::span<glm::vec3> points);
    template <typename Bound, typename Value> float largest(float least, const Bound& bound, const Value& value) const;

    std::vector<glm::vec3> points_; ///< those of a cluster beside each other
    std::vector<Cluster> clusters_;
};

} // namespace nacre::renderer
