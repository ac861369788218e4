#include "trace/illumination.hpp"

#include "trace/punctual.hpp"

#include <cmath>

namespace nacre::trace {
namespace {

double sign(Side side) {
    return side == Side::Front ? 1 : -1;
}

/// Of a light's distance: a shadow ray ends before a surface in which the light lies.
constexpr double shadowRayShare = 0.99999;

} // namespace

Illumination::Illumination(const Geometry& geometry)
    : geometry_(geometry), surroundings_(geometry.scene().environment) {}

bool Illumination::isReached(const SurfacePoint& point, Side side, const glm::dvec3& direction, double distance) const {
    // The rise towards the curved surface is the front's.
    const glm::vec3& start = side == Side::Front ? point.shadowOrigin : point.position;
    Ray ray;
    ray.origin = geometry_.movedOff(start, static_cast<float>(sign(side)) * point.normal);
    ray.direction = glm::vec3(direction);
    ray.tFar = static_cast<float>(distance * shadowRayShare);
    return !geometry_.occluded(ray);
}

glm::dvec3 Illumination::direct(const SurfacePoint& point, Side side) const {
    const scene::Scene& scene = geometry_.scene();
    const glm::dvec3 normal = sign(side) * glm::dvec3(point.shadingNormal);
    glm::dvec3 sum(0);
    for (const scene::Light& light : scene.lights) {
        const Arriving arriving = arrivingLight(light, point.position, scene.metersPerUnit);
        const double cosine = glm::dot(normal, arriving.toLight);
        const glm::dvec3 irradiance = arriving.irradiance * cosine;
        const bool isLit = cosine > 0 && std::max({irradiance.r, irradiance.g, irradiance.b}) > 0;
        if (isLit && (!light.castsShadow || isReached(point, side, arriving.toLight, arriving.distance))) {
            sum += irradiance;
        }
    }
    return sum;
}

glm::dvec3 Illumination::ambient(const SurfacePoint& point, Side side, Random& random) const {
    if (!surroundings_.isLit()) {
        return glm::dvec3(0);
    }
    const glm::dvec3 normal = sign(side) * glm::dvec3(point.shadingNormal);
    const Surroundings::Sample sample = surroundings_.sample(normal, random);
    const double cosine = glm::dot(sample.direction, normal);
    if (!(cosine > 0) || !(sample.density > 0) ||
        !isReached(point, side, sample.direction, std::numeric_limits<double>::infinity())) {
        return glm::dvec3(0);
    }
    return surroundings_.radiance(sample.direction) * (cosine / sample.density);
}

} // namespace nacre::trace
