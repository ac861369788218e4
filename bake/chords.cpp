#include "bake/chords.hpp"

#include "trace/orthonormal_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::bake {
namespace {

constexpr double millimetresPerMetre = 1000;
/// Of the bodies' diagonal: what is met before is the surface itself, or a second one in its place. About 16 steps of a
/// float.
constexpr float nearestShare = 1e-6f;
constexpr int maxCrossings = 256; ///< of one ray, after which it counts as never leaving

std::vector<std::uint32_t> bodiesOf(const scene::Scene& scene) {
    std::vector<std::uint32_t> all;
    std::vector<std::uint32_t> scattering;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        all.push_back(i);
        if (scene.surfaces[scene.meshes[scene.instances[i].mesh].surface].material != scene::none) {
            scattering.push_back(i);
        }
    }
    return scattering.empty() ? all : scattering;
}

/// The bits of i behind the binary point, the last one first (van der Corput).
double radicalInverse(std::uint32_t i) {
    std::uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) {
        reversed |= (i >> bit & 1U) << (31 - bit);
    }
    return reversed * 0x1p-32;
}

} // namespace

Chords::Chords(trace::Geometry& geometry)
    : geometry_(geometry),
      set_(geometry.addSet(bodiesOf(geometry.scene()))),
      millimetresPerUnit_(geometry.scene().metersPerUnit * millimetresPerMetre),
      nearest_(nearestShare * 2 * geometry.bounds(set_).radius()) {}

std::optional<double> Chords::length(const glm::vec3& origin, const glm::vec3& direction) const {
    trace::Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    ray.tNear = nearest_;
    int depth = 1;
    for (int crossing = 0; crossing < maxCrossings; ++crossing) {
        const std::optional<trace::Hit> hit = geometry_.closest(ray, set_);
        if (!hit) {
            return std::nullopt;
        }
        depth += glm::dot(geometry_.placeOf(*hit).normal, direction) > 0 ? -1 : 1;
        if (depth == 0) {
            return hit->distance * millimetresPerUnit_;
        }
        ray.tNear = std::nextafter(hit->distance * (1 + 1e-6f), ray.tFar);
    }
    return std::nullopt;
}

double Chords::diagonal() const {
    return 2 * geometry_.bounds(set_).radius() * millimetresPerUnit_;
}

LocalThickness localThickness(const Chords& chords, const ThicknessLaw& law, const trace::Hit& place,
                              std::uint32_t samples, trace::Random random) {
    const trace::Geometry& geometry = chords.geometry();
    const trace::SurfacePoint point = geometry.surfaceAt(place);
    // The side that the vertex normals point to is the outside, also of a triangle that is wound the other way.
    const double side = glm::dot(point.normal, point.vertexNormal) < 0 ? 1 : -1;
    const glm::dvec3 inward = side * glm::dvec3(point.normal);
    const glm::vec3 origin = geometry.movedOff(point.position, glm::vec3(inward));
    const trace::Frame frame(-glm::dvec3(point.vertexNormal));
    const double cosineShift = random.uniform();
    const double azimuthShift = random.uniform();
    LocalThickness result;
    double sum = 0;
    std::uint32_t counted = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const double cosine = std::sqrt((i + cosineShift) / samples);
        const double turn = radicalInverse(i) + azimuthShift;
        const glm::dvec3 direction = trace::directionAt(frame, cosine, 2 * std::numbers::pi * turn);
        if (glm::dot(direction, inward) <= 0) {
            continue;
        }
        ++counted;
        if (const std::optional<double> chord = chords.length(origin, glm::vec3(direction))) {
            sum += law.transmittance(*chord);
        } else {
            ++result.escaped;
        }
    }
    const double most = std::min(law.longest(), chords.diagonal());
    const double mean = counted > 0 ? sum / counted : 0;
    result.millimetres = mean > 0 ? std::min(law.thickness(mean), most) : most;
    return result;
}

} // namespace nacre::bake
