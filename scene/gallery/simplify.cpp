#include "scene/gallery/simplify.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace nacre::scene::gallery {

namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
/// Weight of the squared edge length against the squared distance: evens the triangles out where all is flat.
constexpr double lengthWeight = 5e-5;
/// A collapse is done when its turn comes unless it has become this much dearer since it was queued.
constexpr double patience = 1.5;

/// Area-weighted sum of squared distances to planes.
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, x = 0, y = 0, z = 0, c = 0, weight = 0;

    void addPlane(const glm::dvec3& n, double d, double w) {
        xx += w * n.x * n.x, xy += w * n.x * n.y, xz += w * n.x * n.z, yy += w * n.y * n.y, yz += w * n.y * n.z;
        zz += w * n.z * n.z, x += w * n.x * d, y += w * n.y * d, z += w * n.z * d, c += w * d * d, weight += w;
    }
    void add(const Quadric& q) {
        xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
        x += q.x, y += q.y, z += q.z, c += q.c, weight += q.weight;
    }
    double at(const glm::dvec3& p) const {
        return p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z + x)) + p.y * (yy * p.y + 2 * (yz * p.z + y)) +
               p.z * (zz * p.z + 2 * z) + c;
    }
};

struct Collapse {
    double cost = 0;
    std::uint32_t vertex = nobody, target = nobody;
    bool operator<(const Collapse& other) const { // the cheapest comes out of the queue first
        return std::tie(cost, vertex) > std::tie(other.cost, other.vertex);
    }
};

class Simplifier {
public:
    explicit Simplifier(Solid& solid)
        : positions_(solid.positions),
          indices_(solid.indices),
          triangles_(solid.triangleCount()),
          quadrics_(positions_.size()),
          queued_(positions_.size(), false),
          stamps_(positions_.size(), 0),
          firstCorner_(positions_.size(), nobody),
          nextCorner_(indices_.size()) {
        for (std::uint32_t corner = 0; corner < indices_.size(); ++corner) {
            nextCorner_[corner] = firstCorner_[indices_[corner]];
            firstCorner_[indices_[corner]] = corner;
        }
        for (std::size_t i = 0; i < indices_.size(); i += 3) {
            const glm::dvec3 a = positions_[indices_[i]];
            const glm::dvec3 cross =
                glm::cross(glm::dvec3(positions_[indices_[i + 1]]) - a, glm::dvec3(positions_[indices_[i + 2]]) - a);
            const double length = glm::length(cross);
            if (length == 0)
                continue;
            for (int c = 0; c < 3; ++c)
                quadrics_[indices_[i + c]].addPlane(cross / length, -glm::dot(cross, a) / length, length / 2);
        }
    }

    /// Every vertex stands in the queue once, with a cost that may be out of date. It is looked at again when its turn
    /// comes, and waits for its new turn if others have become cheaper.
    void run(std::size_t target) {
        for (std::uint32_t v = 0; v < positions_.size(); ++v)
            enqueue(v);
        while (triangles_ > target && !queue_.empty()) {
            const Collapse turn = queue_.top();
            queue_.pop();
            const double limit = patience * turn.cost;
            Collapse best = cheapest(turn.vertex, false);
            if (best.cost <= limit && !allowed(best.vertex, best.target))
                best = cheapest(turn.vertex, true);
            queued_[turn.vertex] = best.target != nobody && best.cost > limit;
            if (queued_[turn.vertex])
                queue_.push(best);
            else if (best.target != nobody)
                collapse(best.vertex, best.target);
        }
        std::erase_if(indices_, [](std::uint32_t index) { return index == nobody; });
    }

private:
    template <typename Visit> void forCorners(std::uint32_t v, Visit visit) const {
        for (std::uint32_t corner = firstCorner_[v]; corner != nobody; corner = nextCorner_[corner])
            visit(corner);
    }
    std::uint32_t after(std::uint32_t corner) const { return indices_[corner % 3 == 2 ? corner - 2 : corner + 1]; }
    std::uint32_t before(std::uint32_t corner) const { return indices_[corner % 3 == 0 ? corner + 2 : corner - 1]; }

    /// In a closed manifold every neighbour follows the vertex in exactly one triangle.
    std::size_t valence(std::uint32_t v) const {
        std::size_t count = 0;
        forCorners(v, [&](std::uint32_t) { ++count; });
        return count;
    }

    double cost(std::uint32_t v, std::uint32_t target) const {
        const glm::dvec3 from = positions_[v], to = positions_[target];
        const Quadric &a = quadrics_[v], &b = quadrics_[target];
        return std::max(a.at(to) + b.at(to), 0.0) / (a.weight + b.weight) +
               lengthWeight * glm::dot(to - from, to - from);
    }

    Collapse cheapest(std::uint32_t v, bool check) const {
        Collapse best{std::numeric_limits<double>::max(), v, nobody};
        forCorners(v, [&](std::uint32_t corner) {
            const Collapse candidate{cost(v, after(corner)), v, after(corner)};
            if (std::tie(candidate.cost, candidate.target) < std::tie(best.cost, best.target) &&
                (!check || allowed(v, candidate.target)))
                best = candidate;
        });
        return best;
    }

    void enqueue(std::uint32_t v) {
        if (queued_[v])
            return;
        const Collapse best = cheapest(v, false);
        queued_[v] = best.target != nobody;
        if (queued_[v])
            queue_.push(best);
    }

    bool allowed(std::uint32_t v, std::uint32_t target) const {
        ++stamp_;
        forCorners(target, [&](std::uint32_t corner) { stamps_[after(corner)] = stamp_; });
        std::size_t common = 0;
        bool opposed = true;
        forCorners(v, [&](std::uint32_t corner) {
            common += stamps_[after(corner)] == stamp_;
            if (after(corner) == target)
                opposed &= valence(before(corner)) > 3;
            if (before(corner) == target)
                opposed &= valence(after(corner)) > 3;
        });
        return common == 2 && opposed && keepsShape(v, target);
    }

    /// No triangle turns over, and none becomes a sliver unless there was one.
    bool keepsShape(std::uint32_t v, std::uint32_t target) const {
        float worstBefore = 1, worstAfter = 1;
        bool upright = true;
        forCorners(v, [&](std::uint32_t corner) {
            if (after(corner) == target || before(corner) == target)
                return;
            const glm::vec3 b = positions_[after(corner)], c = positions_[before(corner)];
            const glm::vec3 was = glm::cross(b - positions_[v], c - positions_[v]);
            const glm::vec3 is = glm::cross(b - positions_[target], c - positions_[target]);
            upright &= glm::dot(was, is) > 0.3f * glm::length(was) * glm::length(is);
            worstBefore = std::min(worstBefore, quality(positions_[v], b, c));
            worstAfter = std::min(worstAfter, quality(positions_[target], b, c));
        });
        return upright && worstAfter > 1e-3f && worstAfter > std::min(worstBefore, 0.15f);
    }

    /// 1 for an equilateral triangle, 0 for a degenerate one.
    static float quality(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const float squares = glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(a - c, a - c);
        return squares > 0 ? 3.4641016f * glm::length(glm::cross(b - a, c - a)) / squares : 0.f;
    }

    void collapse(std::uint32_t v, std::uint32_t target) {
        for (std::uint32_t corner = firstCorner_[v], next = 0; corner != nobody; corner = next) {
            next = nextCorner_[corner];
            if (after(corner) == target || before(corner) == target) {
                removeTriangle(corner / 3, v);
                continue;
            }
            indices_[corner] = target;
            nextCorner_[corner] = firstCorner_[target];
            firstCorner_[target] = corner;
        }
        firstCorner_[v] = nobody;
        quadrics_[target].add(quadrics_[v]);
        enqueue(target);
        forCorners(target, [&](std::uint32_t corner) { enqueue(after(corner)); });
    }

    /// `walked`'s own list is being walked and dropped by the caller.
    void removeTriangle(std::uint32_t triangle, std::uint32_t walked) {
        for (std::uint32_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
            if (indices_[corner] == walked)
                continue;
            std::uint32_t* link = &firstCorner_[indices_[corner]];
            while (*link != corner)
                link = &nextCorner_[*link];
            *link = nextCorner_[corner];
        }
        std::fill_n(indices_.begin() + 3 * std::ptrdiff_t(triangle), 3, nobody);
        --triangles_;
    }

    const std::vector<glm::vec3>& positions_;
    std::vector<std::uint32_t>& indices_;
    std::size_t triangles_;
    std::vector<Quadric> quadrics_;
    std::vector<bool> queued_;
    mutable std::vector<std::uint32_t> stamps_; ///< per vertex: the last question in which it was a neighbour
    mutable std::uint32_t stamp_ = 0;
    std::vector<std::uint32_t> firstCorner_; ///< per vertex, the list of triangle corners that stand on it
    std::vector<std::uint32_t> nextCorner_;
    std::priority_queue<Collapse> queue_;
};

void dropUnusedVertices(Solid& solid) {
    std::vector<std::uint32_t> place(solid.positions.size(), nobody);
    std::vector<glm::vec3> kept;
    for (std::uint32_t& index : solid.indices) {
        if (place[index] == nobody) {
            place[index] = std::uint32_t(kept.size());
            kept.push_back(solid.positions[index]);
        }
        index = place[index];
    }
    solid.positions = std::move(kept);
}

} // namespace

void simplify(Solid& solid, std::size_t triangles) {
    Simplifier(solid).run(triangles);
    dropUnusedVertices(solid);
}

} // namespace nacre::scene::gallery
