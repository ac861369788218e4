#include "reference/surface_integral.hpp"

#include "trace/orthonormal_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace nacre::reference {
namespace {

/// A share of the samples' weight below which points are lit only sometimes, and then counted for more.
constexpr double negligibleWeight = 1e-4;
/// Where a line starts, as a share of its half: off the surface that it is about to meet.
constexpr double liftShare = 0.0731;

std::vector<std::uint32_t> instancesThatExchange(const scene::Scene& scene, std::uint32_t material, bool exchange) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const std::uint32_t other = scene.surfaces[scene.meshes[scene.instances[i].mesh].surface].material;
        if (other != scene::none && (exchange || other == material)) {
            result.push_back(i);
        }
    }
    return result;
}

} // namespace

/// What the lines of one sample have in common.
struct SurfaceIntegral::Probe {
    const Receiver& receiver;
    glm::dvec3 position;
    std::array<glm::dvec3, 3> axes; ///< the normal and two perpendicular to it
    std::optional<Wall> wall;
    double millimetres; ///< of the profile, per scene unit: fewer where the point's scale makes the profile wider

    /// How many lines along each axis a sample has, a channel: one along the normal, and one for both others and all
    /// channels together.
    double lines(int axis) const {
        return axis == 0 ? 1.0 : 0.5 / static_cast<double>(receiver.radii->channels().size());
    }
};

SurfaceIntegral::SurfaceIntegral(trace::Geometry& geometry, const EntryLight& light, bool exchange)
    : geometry_(geometry), light_(light), millimetres_(1000 * geometry.scene().metersPerUnit) {
    const scene::Scene& scene = geometry.scene();
    std::map<std::vector<std::uint32_t>, trace::InstanceSet> sets;
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        Receiver receiver;
        receiver.profile = makeProfile(material);
        receiver.radii = std::make_unique<RadiusSampler>(*receiver.profile);
        receiver.usesEntryAlbedo = material.albedoUse == AlbedoUse::PreAndPost;
        receiver.strength = material.strength;
        const std::vector<std::uint32_t> instances = instancesThatExchange(scene, i, exchange);
        if (!sets.contains(instances)) {
            sets[instances] = geometry.addSet(instances);
        }
        receiver.surfaces = sets[instances];
        receivers_.push_back(std::move(receiver));
    }
}

glm::dvec3 SurfaceIntegral::entering(const Probe& probe, const trace::SurfacePoint& point,
                                     trace::Random& random) const {
    if (probe.wall) {
        return light_.entering(point, *probe.wall, random);
    }
    const glm::dvec3 light = light_.entering(point, random);
    return probe.receiver.usesEntryAlbedo ? light * glm::sqrt(glm::dvec3(point.albedo)) : light;
}

glm::dvec3 SurfaceIntegral::contribution(const Probe& probe, const trace::Hit& hit, trace::Random& random) const {
    const trace::Place place = geometry_.placeOf(hit);
    const glm::dvec3 offset = (glm::dvec3(place.position) - probe.position) * probe.millimetres;
    const double distance = glm::length(offset);
    const RadiusSampler& radii = *probe.receiver.radii;
    if (distance >= radii.reach()) {
        return glm::dvec3(0);
    }
    double density = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 aside = offset - probe.axes[axis] * glm::dot(offset, probe.axes[axis]);
        density += probe.lines(axis) * std::abs(glm::dot(probe.axes[axis], glm::dvec3(place.normal))) *
                   radii.density(glm::length(aside));
    }
    glm::dvec3 weight(0);
    for (int channel = 0; channel < 3; ++channel) {
        weight[channel] = probe.receiver.profile->radial(channel, std::max(distance, 1e-9)) / density;
    }
    const double chance = std::min(1.0, std::max({weight.r, weight.g, weight.b}) / negligibleWeight);
    if (!(density > 0) || (chance < 1 && random.uniform() >= chance)) {
        return glm::dvec3(0);
    }
    return weight / chance * entering(probe, geometry_.surfaceAt(hit), random);
}

glm::dvec3 SurfaceIntegral::alongLine(const Probe& probe, int axis, int channel, trace::Random& random) const {
    const RadiusSampler& radii = *probe.receiver.radii;
    const double radius = radii.sample(channel, random.uniform());
    const double azimuth = 2 * std::numbers::pi * random.uniform();
    const glm::dvec3& along = probe.axes[axis];
    const glm::dvec3 aside =
        std::cos(azimuth) * probe.axes[(axis + 1) % 3] + std::sin(azimuth) * probe.axes[(axis + 2) % 3];
    // Half the chord of the sphere that reach() is the radius of. It is walked in both directions from a point that is
    // not on the surface.
    const double half = std::sqrt(std::max(0.0, radii.reach() * radii.reach() - radius * radius));
    const double lift = liftShare * half;
    glm::dvec3 sum(0);
    for (const double direction : {-1.0, 1.0}) {
        trace::Ray ray;
        ray.origin = glm::vec3(probe.position + (radius * aside + lift * along) / probe.millimetres);
        ray.direction = glm::vec3(direction * along);
        ray.tFar = static_cast<float>((half - direction * lift) / probe.millimetres);
        while (const std::optional<trace::Hit> hit = geometry_.closest(ray, probe.receiver.surfaces)) {
            sum += contribution(probe, *hit, random);
            ray.tNear = std::nextafter(hit->distance, std::numeric_limits<float>::infinity());
        }
    }
    return sum;
}

glm::dvec3 SurfaceIntegral::integrate(const trace::SurfacePoint& point, const std::optional<Wall>& wall,
                                      trace::Random& random) const {
    const Receiver& receiver = receivers_[point.material];
    const RadiusSampler& radii = *receiver.radii;
    const trace::Frame frame{glm::dvec3(point.normal)};
    const Probe probe{receiver,
                      glm::dvec3(point.position),
                      {frame.normal, frame.tangent, frame.bitangent},
                      wall,
                      millimetres_ / static_cast<double>(point.scale)};
    glm::dvec3 sum(0);
    for (const int channel : radii.channels()) {
        sum += alongLine(probe, 0, channel, random);
    }
    if (!radii.channels().empty()) {
        const int axis = random.uniform() < 0.5 ? 1 : 2;
        const auto pick = static_cast<std::size_t>(random.uniform() * static_cast<double>(radii.channels().size()));
        sum += alongLine(probe, axis, radii.channels()[pick], random);
    }
    const Rgb& here = radii.pointShare();
    if (here[0] + here[1] + here[2] > 0) {
        sum += glm::dvec3(here[0], here[1], here[2]) * entering(probe, point, random);
    }
    return sum;
}

glm::dvec3 SurfaceIntegral::scattered(const trace::SurfacePoint& point, trace::Random& random) const {
    return integrate(point, std::nullopt, random);
}

glm::dvec3 SurfaceIntegral::radiance(const trace::SurfacePoint& point, bool seenFromBehind, trace::Random& random,
                                     Incidents& /*incidents*/) const {
    const Receiver& receiver = receivers_[point.material];
    const glm::dvec3 albedo(point.albedo);
    const std::optional<Wall> wall = wallOf(geometry_.scene().materials[point.material], point, seenFromBehind);
    const glm::dvec3 leaving = wall ? glm::dvec3(1) : receiver.usesEntryAlbedo ? glm::sqrt(albedo) : albedo;
    const double strength = receiver.strength * static_cast<double>(point.strengthFactor);
    glm::dvec3 sum = strength * leaving * integrate(point, wall, random);
    if (strength < 1) {
        const trace::Side side = seenFromBehind ? trace::Side::Back : trace::Side::Front;
        const glm::dvec3 here =
            wall ? light_.entering(point, *wall, random) : albedo * light_.irradiance(point, side, random);
        sum += (1 - strength) * here;
    }
    return sum / std::numbers::pi;
}

} // namespace nacre::reference
