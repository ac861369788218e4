// Directional, spot and point lights (KHR_lights_punctual), as the renderer has them.
#pragma once

#include "scene/scene.hpp"

namespace nacre::trace {

/// What a light brings to a point.
struct Arriving {
    glm::dvec3 irradiance{0}; ///< on a surface that faces the light, without shadows
    glm::dvec3 toLight{0};    ///< unit
    double distance = 0;      ///< scene units; infinite for directional lights
};

/// Inverse square in metres, clamped to 1e-8 m², a window up to the light's range, and a spot's cone squared
/// (KHR_lights_punctual, "Range Property" and "Inner and Outer Cone Angles").
Arriving arrivingLight(const scene::Light& light, const glm::dvec3& position, double metersPerUnit);

} // namespace nacre::trace
