// What a reference method is to the rest: the diffuse radiance of a point of a subsurface body, estimated.
#pragma once

#include "trace/geometry.hpp"
#include "trace/random.hpp"

namespace nacre::reference {

/// Counts of what a method met and could not treat as it should. All are sums over samples.
struct Incidents {
    std::uint64_t paths = 0;      ///< walks that were begun
    std::uint64_t lost = 0;       ///< walks that left a body where its mesh is open; their light is missing
    std::uint64_t overlapped = 0; ///< walks that crossed a second surface of the body from outside before they left it
    std::uint64_t cut = 0;        ///< walks ended at the largest number of steps; their light is missing

    Incidents& operator+=(const Incidents& other) {
        paths += other.paths;
        lost += other.lost;
        overlapped += other.overlapped;
        cut += other.cut;
        return *this;
    }
    bool operator==(const Incidents&) const = default;
};

class Estimator {
public:
    virtual ~Estimator() = default;

    /// One estimate of the diffuse radiance that leaves `point`, whose surface has a subsurface material, towards the
    /// camera; its mean over `random` is the method's result. `seenFromBehind`: the camera sees
    /// the back of a double-sided surface. Safe to call from many threads.
    virtual glm::dvec3 radiance(const trace::SurfacePoint& point, bool seenFromBehind, trace::Random& random,
                                Incidents& incidents) const = 0;
};

} // namespace nacre::reference
