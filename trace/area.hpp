// Points spread evenly over a surface.
#pragma once

#include "trace/geometry.hpp"
#include "trace/random.hpp"

namespace nacre::trace {

/// The triangles of some instances, chosen in proportion to their area. Holes of masked surfaces count as area.
class AreaSampler {
public:
    AreaSampler(const Geometry& geometry, std::span<const std::uint32_t> instances);

    /// Scene units squared; 0 when there is nothing to sample.
    double area() const { return cumulative_.empty() ? 0 : cumulative_.back(); }
    /// A point with the density 1 / area(). area() must be above 0.
    Hit sample(Random& random) const;

private:
    struct Triangle {
        std::uint32_t instance;
        std::uint32_t index;
    };
    std::vector<Triangle> triangles_;
    std::vector<double> cumulative_;
};

} // namespace nacre::trace
