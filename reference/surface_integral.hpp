// The surface integral: what scatter and transmit together are meant to be, over the whole surface.
//
//     radiance(x) = albedo / π · ∫ R(|x − y|) E(y) dA(y)
//
// y runs over every surface that exchanges light with x's material, whether the camera sees it or not; R is the
// receiver's profile over the straight distance, with its lengths times the surface's scale at x, E the irradiance with
// traced shadows.
#pragma once

#include "nacre/material.hpp"
#include "reference/entry_light.hpp"
#include "reference/estimator.hpp"
#include "reference/radius_sampler.hpp"

namespace nacre::reference {

/// Estimates by probes: straight lines through the surface along the normal and two directions perpendicular to it, at
/// distances that follow the profile of each channel. Every point that a line meets counts, weighed by the density with
/// which all lines together meet it (balance heuristic: Veach and Guibas 1995; probes: King, Kulla, Conty and Fajardo
/// 2013, "BSSRDF importance sampling"). Weights are bounded where R falls with the distance, for one axis always meets
/// a surface at less than 55 degrees. What lies beyond RadiusSampler::reach is left out, nothing else.
class SurfaceIntegral final : public Estimator {
public:
    /// `geometry` and `light` must outlive it. exchange: light crosses between all subsurface bodies, as the effect has
    /// it when every material is in every exchange group; otherwise only between bodies of one material.
    SurfaceIntegral(trace::Geometry& geometry, const EntryLight& light, bool exchange);

    glm::dvec3 radiance(const trace::SurfacePoint& point, bool seenFromBehind, trace::Random& random,
                        Incidents& incidents) const override;

    /// One estimate of ∫ R E dA at a point of a subsurface body (with √albedo of the entry points where the material
    /// asks for it), as irradiance.
    glm::dvec3 scattered(const trace::SurfacePoint& point, trace::Random& random) const;

private:
    struct Receiver {
        std::unique_ptr<Profile> profile;
        std::unique_ptr<RadiusSampler> radii;
        trace::InstanceSet surfaces = trace::allInstances;
        bool usesEntryAlbedo = false;
        double strength = 1;
    };
    struct Probe;

    glm::dvec3 integrate(const trace::SurfacePoint& point, const std::optional<Wall>& wall,
                         trace::Random& random) const;
    glm::dvec3 entering(const Probe& probe, const trace::SurfacePoint& point, trace::Random& random) const;
    glm::dvec3 alongLine(const Probe& probe, int axis, int channel, trace::Random& random) const;
    glm::dvec3 contribution(const Probe& probe, const trace::Hit& hit, trace::Random& random) const;

    const trace::Geometry& geometry_;
    const EntryLight& light_;
    double millimetres_ = 1000;       ///< per scene unit
    std::vector<Receiver> receivers_; ///< by material
};

} // namespace nacre::reference
