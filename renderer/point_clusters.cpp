#include "renderer/point_clusters.hpp"

#include <algorithm>
#include <limits>

namespace nacre::renderer {
namespace {

constexpr std::size_t mostPoints = 64; ///< of a cluster
/// Of the numbers that a bound is the sum of: it stays above what its points give after rounding.
constexpr float rounding = 1e-5f;

struct Box {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};
};

Box boxOf(std::span<const glm::vec3> points) {
    Box box;
    for (const glm::vec3& point : points) {
        box = {glm::min(box.low, point), glm::max(box.high, point)};
    }
    return box;
}

int longestAxis(const glm::vec3& size) {
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

} // namespace

PointClusters::PointClusters(std::vector<glm::vec3> points) : points_(std::move(points)) {
    split(points_);
}

void PointClusters::split(std::span<glm::vec3> points) {
    if (points.empty()) {
        return;
    }
    const Box box = boxOf(points);
    if (points.size() <= mostPoints) {
        clusters_.push_back({points, 0.5f * (box.low + box.high), 0.5f * (box.high - box.low)});
        return;
    }
    const int axis = longestAxis(box.high - box.low);
    const std::size_t half = points.size() / 2;
    std::ranges::nth_element(points, points.begin() + static_cast<std::ptrdiff_t>(half), {},
                             [axis](const glm::vec3& point) { return point[axis]; });
    split(points.first(half));
    split(points.subspan(half));
}

/// The largest value of any point, and at least `least`. A cluster is looked at where its bound is above what is there;
/// the one with the highest bound comes first, so that few others are.
template <typename Bound, typename Value>
float PointClusters::largest(float least, const Bound& bound, const Value& value) const {
    const auto lookAt = [&](const Cluster& cluster) {
        for (const glm::vec3& point : cluster.points) {
            least = std::max(least, value(point));
        }
    };
    const auto first = std::ranges::max_element(clusters_, {}, bound);
    if (first == clusters_.end()) {
        return least;
    }
    lookAt(*first);
    for (const Cluster& cluster : clusters_) {
        if (!(bound(cluster) <= least)) {
            lookAt(cluster);
        }
    }
    return least;
}

Interval PointClusters::extend(const Interval& interval, const glm::vec3& axis) const {
    const glm::vec3 size = glm::abs(axis);
    const auto slack = [&](const Cluster& cluster) {
        return glm::dot(cluster.half, size) + rounding * glm::dot(glm::abs(cluster.center) + cluster.half, size);
    };
    const float high = largest(
        interval.high, [&](const Cluster& cluster) { return glm::dot(axis, cluster.center) + slack(cluster); },
        [&](const glm::vec3& point) { return glm::dot(axis, point); });
    const float low = largest(
        -interval.low, [&](const Cluster& cluster) { return slack(cluster) - glm::dot(axis, cluster.center); },
        [&](const glm::vec3& point) { return -glm::dot(axis, point); });
    return {-low, high};
}

float PointClusters::farthest(float distance, const glm::vec3& place) const {
    return largest(
        distance,
        [&](const Cluster& cluster) {
            const glm::vec3 apart = glm::abs(cluster.center - place) + cluster.half;
            return glm::length(apart + rounding * (glm::abs(cluster.center) + glm::abs(place)));
        },
        [&](const glm::vec3& point) { return glm::distance(point, place); });
}

} // namespace nacre::renderer
