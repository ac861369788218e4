// The random walk: light as it travels from one event to the next inside the mesh, without any profile.
#pragma once

#include "reference/entry_light.hpp"
#include "reference/estimator.hpp"
#include "reference/medium.hpp"
#include "trace/orthonormal_frame.hpp"

namespace nacre::reference {

/// Path tracing through the medium of a body, from the camera to the light. A path enters the body diffusely, travels
/// by free flights and Henyey and Greenstein's phase function, and leaves where it meets the body's surface from
/// within; there it takes the irradiance of all lights and surroundings as an even radiance E / π. Evenly lit and
/// thick, a body therefore shows albedo · E / π, as in the renderer.
///
/// One flight serves three channels: its length follows a channel that is chosen in proportion to what the channels
/// carry, and every channel is weighed by the mean of the densities (one-sample balance heuristic, as in Chiang, Kutz
/// and Burley 2016). What the channels carry together never grows. Russian roulette ends paths that carry little.
///
/// Rules. The body is all that has the material of the point where the path enters; others are not there for it. Where
/// surfaces of the body overlap it leaves when it has left all that it has entered. Where a mesh is open, paths that do
/// not come back are lost, and counted (Incidents). A thin wall has no inside: its light is divided between its sides
/// and does not spread.
class RandomWalk final : public Estimator {
public:
    /// `geometry` and `light` must outlive it.
    RandomWalk(trace::Geometry& geometry, const EntryLight& light, Boundary boundary, double anisotropy);

    glm::dvec3 radiance(const trace::SurfacePoint& point, bool seenFromBehind, trace::Random& random,
                        Incidents& incidents) const override;

    /// Where a walk left, what of each channel is left of 1, and which way it went, as seen from within.
    struct Exit {
        trace::Hit hit;
        glm::dvec3 weight{0};
        glm::dvec3 direction{0};
    };
    /// A walk through the body of `material` that starts just under `start` in `direction` (unit). Nothing when it did
    /// not come out.
    std::optional<Exit> walk(const WalkMedium& medium, std::uint32_t material, const trace::Place& start,
                             const glm::dvec3& direction, trace::Random& random, Incidents& incidents) const;

    /// What to know of the scene before walking through it, a sentence each.
    std::vector<std::string> warnings() const;

private:
    struct Body {
        MediumModel model;
        trace::InstanceSet surfaces;
        std::uint64_t openEdges;
        double strength;
    };
    struct Path;

    bool fly(Path& path) const;
    std::vector<std::string> bodiesWithin(std::uint32_t material) const;
    bool isWithin(const glm::vec3& point, trace::InstanceSet set) const;
    bool isAway(const Path& path) const;

    const trace::Geometry& geometry_;
    const EntryLight& light_;
    Boundary boundary_;
    double millimetres_ = 1000; ///< per scene unit
    std::vector<Body> bodies_;  ///< by material
};

} // namespace nacre::reference
