// The light that enters a body: traced, or as a renderer has it.
#pragma once

#include "trace/illumination.hpp"
#include "trace/view.hpp"

namespace nacre::reference {

/// A sheet without an inside (Material::diffuseTransmission) as it is seen from one side: what of the light on either
/// side reaches the eye.
struct Wall {
    trace::Side nearSide = trace::Side::Front; ///< towards the camera
    glm::dvec3 nearWeight{1};                  ///< (1 − f) · albedo
    glm::dvec3 farWeight{0};                   ///< f · colour of what comes through
};

/// The material's wall at a point, with its albedo and what textures say there; nothing when it is of closed bodies.
std::optional<Wall> wallOf(const Material& material, const trace::SurfacePoint& point, bool seenFromBehind);

/// Irradiance at entry points. Without an image it is traced. With the irradiance image of `nacre render` (--aov
/// irradiance=FILE) points that the camera sees take the pixel they fall on, so that the renderer's shadow maps and its
/// surroundings are in both pictures and what still differs is scattering; points it does not see are traced.
class EntryLight {
public:
    explicit EntryLight(const trace::Geometry& geometry);

    const trace::Illumination& illumination() const { return illumination_; }

    /// From now on `image` is the irradiance that `view` sees; it covers the whole picture, with any number of pixels.
    void setRendered(const trace::View& view, const glm::dvec2& pictureSize, nacre::Image image);

    /// One estimate of what enters at `point`, from both sides where its surface is double-sided.
    glm::dvec3 entering(const trace::SurfacePoint& point, trace::Random& random) const;
    /// The same through a wall, weighed by its colours.
    glm::dvec3 entering(const trace::SurfacePoint& point, const Wall& wall, trace::Random& random) const;
    /// One estimate of the irradiance on one side.
    glm::dvec3 irradiance(const trace::SurfacePoint& point, trace::Side side, trace::Random& random) const;

private:
    std::optional<glm::dvec3> rendered(const trace::SurfacePoint& point, trace::Side side) const;

    const trace::Geometry& geometry_;
    trace::Illumination illumination_;
    std::optional<trace::View> view_;
    glm::dvec2 pictureSize_{1};
    nacre::Image image_;
};

} // namespace nacre::reference
