#include "trace/punctual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nacre::trace {

Arriving arrivingLight(const scene::Light& light, const glm::dvec3& position, double metersPerUnit) {
    const glm::dvec3 irradiance = glm::dvec3(light.color) * static_cast<double>(light.intensity);
    if (light.kind == scene::LightKind::Directional) {
        return {irradiance, -glm::normalize(glm::dvec3(light.direction)), std::numeric_limits<double>::infinity()};
    }
    const glm::dvec3 offset = glm::dvec3(light.position) - position;
    const double distance = glm::length(offset);
    const glm::dvec3 toLight = offset / std::max(distance, 1e-20);
    const double meters = distance * metersPerUnit;
    const double ratio = light.range > 0 ? meters / light.range : 0;
    const double falloff = std::clamp(1 - ratio * ratio * ratio * ratio, 0.0, 1.0) / std::max(meters * meters, 1e-8);
    double cone = 1;
    if (light.kind == scene::LightKind::Spot) {
        const double cosOuter = std::cos(static_cast<double>(light.outerConeAngle));
        const double scale = 1 / std::max(0.001, std::cos(static_cast<double>(light.innerConeAngle)) - cosOuter);
        const double cosine = -glm::dot(glm::normalize(glm::dvec3(light.direction)), toLight);
        cone = std::clamp((cosine - cosOuter) * scale, 0.0, 1.0);
    }
    return {irradiance * (falloff * cone * cone), toLight, distance};
}

} // namespace nacre::trace
