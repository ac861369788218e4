// Irradiance at a point of a surface, with traced shadows.
#pragma once

#include "trace/geometry.hpp"
#include "trace/random.hpp"
#include "trace/surroundings.hpp"

namespace nacre::trace {

/// Which side of a surface is lit.
enum class Side { Front, Back };

/// The lights and surroundings of a scene over its geometry, both of which must outlive it. Safe to ask from many
/// threads.
class Illumination {
public:
    explicit Illumination(const Geometry& geometry);

    /// Irradiance of all lights, exact but for rounding: light · max(0, shading normal · direction), where nothing is
    /// in the way.
    glm::dvec3 direct(const SurfacePoint& point, Side side = Side::Front) const;
    /// One estimate of the surroundings' irradiance; its mean over `random` is exact.
    glm::dvec3 ambient(const SurfacePoint& point, Side side, Random& random) const;
    /// direct + ambient.
    glm::dvec3 irradiance(const SurfacePoint& point, Side side, Random& random) const {
        return direct(point, side) + ambient(point, side, random);
    }

private:
    bool isReached(const SurfacePoint& point, Side side, const glm::dvec3& direction, double distance) const;

    const Geometry& geometry_;
    Surroundings surroundings_;
};

} // namespace nacre::trace
