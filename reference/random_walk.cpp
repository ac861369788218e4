#include "reference/random_walk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::reference {
namespace {

constexpr double walkPi = std::numbers::pi;
constexpr std::uint32_t maxSteps = 1000000;
/// Below this share of the light a path goes on by lot.
constexpr double rouletteBelow = 0.1;
/// Paths this many radii of an open body away from it are lost.
constexpr float awayInRadii = 4;

std::vector<std::uint32_t> instancesOf(const scene::Scene& scene, std::uint32_t material) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        if (scene.surfaces[scene.meshes[scene.instances[i].mesh].surface].material == material) {
            result.push_back(i);
        }
    }
    return result;
}

/// Henyey and Greenstein 1941.
double scatteringCosine(double anisotropy, double number) {
    if (std::abs(anisotropy) < 1e-3) {
        return 2 * number - 1;
    }
    const double ratio = (1 - anisotropy * anisotropy) / (1 - anisotropy + 2 * anisotropy * number);
    return std::clamp((1 + anisotropy * anisotropy - ratio * ratio) / (2 * anisotropy), -1.0, 1.0);
}

/// Reflectance of unpolarised light within a medium at its surface, by Fresnel; 1 beyond the critical angle.
double internalReflectance(double cosine, double refractiveIndex) {
    const double sine = refractiveIndex * std::sqrt(std::max(0.0, 1 - cosine * cosine)); // outside
    if (sine >= 1) {
        return 1;
    }
    const double outside = std::sqrt(1 - sine * sine);
    const double parallel = (refractiveIndex * outside - cosine) / (refractiveIndex * outside + cosine);
    const double perpendicular = (refractiveIndex * cosine - outside) / (refractiveIndex * cosine + outside);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

glm::dvec3 toVector(const Rgb& value) {
    return {value[0], value[1], value[2]};
}

} // namespace

struct RandomWalk::Path {
    const WalkMedium& medium;
    const Body& body;
    trace::Random& random;
    glm::dvec3 position;
    glm::dvec3 direction;
    glm::dvec3 carried{1}; ///< per channel
    int depth = 1;         ///< surfaces entered and not left
    bool overlapped = false;
    std::optional<trace::Hit> exit;

    double total() const { return carried.r + carried.g + carried.b; }

    /// Divides what a flight of this length leaves over by the mean of the densities. `scattered`: it ends in an event.
    void carry(double length, bool scattered) {
        glm::dvec3 density(0);
        for (int channel = 0; channel < 3; ++channel) {
            density[channel] = std::exp(-medium.extinction[channel] * length);
            density[channel] *= scattered ? medium.extinction[channel] : 1;
        }
        const double mean = glm::dot(carried, density) / total();
        if (!(mean > 0)) { // too far for every channel
            carried = glm::dvec3(0);
            return;
        }
        carried *= density / mean;
        if (scattered) {
            carried *= toVector(medium.albedo);
        }
    }
    double flightLength() {
        double pick = random.uniform() * total();
        int channel = 0;
        while (channel < 2 && pick >= carried[channel]) {
            pick -= carried[channel];
            ++channel;
        }
        return -std::log(random.uniform()) / medium.extinction[channel];
    }
    /// Whether the path goes on.
    bool survives() {
        const double most = std::max({carried.r, carried.g, carried.b});
        if (most >= rouletteBelow) {
            return true;
        }
        const double chance = most / rouletteBelow;
        if (!(random.uniform() < chance)) {
            return false;
        }
        carried /= chance;
        return true;
    }
};

RandomWalk::RandomWalk(trace::Geometry& geometry, const EntryLight& light, Boundary boundary, double anisotropy)
    : geometry_(geometry), light_(light), boundary_(boundary), millimetres_(1000 * geometry.scene().metersPerUnit) {
    const scene::Scene& scene = geometry.scene();
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        const trace::InstanceSet surfaces = geometry.addSet(instancesOf(scene, i));
        bodies_.push_back({MediumModel(scene.materials[i], boundary, anisotropy), surfaces,
                           geometry.openEdges(surfaces), scene.materials[i].strength});
    }
}

bool RandomWalk::isAway(const Path& path) const {
    const scene::Bounds& bounds = geometry_.bounds(path.body.surfaces);
    const float radii = path.body.openEdges > 0 ? awayInRadii : 1.01f;
    return glm::distance(glm::vec3(path.position), bounds.center()) > radii * bounds.radius();
}

/// One flight to the next event or surface; false when the path has ended there.
bool RandomWalk::fly(Path& path) const {
    const double length = path.flightLength();
    trace::Ray ray;
    ray.origin = glm::vec3(path.position);
    ray.direction = glm::vec3(path.direction);
    ray.tFar = static_cast<float>(length / millimetres_);
    const std::optional<trace::Hit> hit = geometry_.closest(ray, path.body.surfaces);
    if (!hit) {
        path.carry(length, true);
        path.position += path.direction * (length / millimetres_);
        const double cosine = scatteringCosine(path.medium.anisotropy, path.random.uniform());
        path.direction = glm::normalize(
            trace::directionAt(trace::Frame(path.direction), cosine, 2 * walkPi * path.random.uniform()));
        return path.survives();
    }
    path.carry(hit->distance * millimetres_, false);
    const trace::Place place = geometry_.placeOf(*hit);
    const glm::dvec3 normal(place.normal);
    const double cosine = glm::dot(path.direction, normal);
    const bool leaves = cosine > 0;
    bool goesOn = true;
    glm::vec3 beyond = leaves ? place.normal : -place.normal;
    if (leaves && path.depth == 1) {
        goesOn = path.medium.refractiveIndex > 1 &&
                 path.random.uniform() < internalReflectance(cosine, path.medium.refractiveIndex);
        if (goesOn) {
            path.direction -= 2 * cosine * normal;
            beyond = -place.normal;
        } else {
            path.exit = hit;
        }
    } else {
        path.depth += leaves ? -1 : 1;
        path.overlapped = path.overlapped || !leaves;
    }
    path.position = glm::dvec3(geometry_.movedOff(place.position, beyond));
    return goesOn && path.survives();
}

std::optional<RandomWalk::Exit> RandomWalk::walk(const WalkMedium& medium, std::uint32_t material,
                                                 const trace::Place& start, const glm::dvec3& direction,
                                                 trace::Random& random, Incidents& incidents) const {
    Path path{medium, bodies_[material], random, glm::dvec3(geometry_.movedOff(start.position, -start.normal)),
              direction};
    ++incidents.paths;
    for (std::uint32_t step = 0; step < maxSteps; ++step) {
        if (!fly(path)) {
            incidents.overlapped += path.overlapped ? 1 : 0;
            return path.exit ? std::optional(Exit{*path.exit, path.carried, path.direction}) : std::nullopt;
        }
        if (isAway(path)) {
            ++incidents.lost;
            return std::nullopt;
        }
    }
    ++incidents.cut;
    return std::nullopt;
}

glm::dvec3 RandomWalk::radiance(const trace::SurfacePoint& point, bool seenFromBehind, trace::Random& random,
                                Incidents& incidents) const {
    const Material& material = geometry_.scene().materials[point.material];
    if (const auto wall = wallOf(material, point, seenFromBehind)) {
        return light_.entering(point, *wall, random) / walkPi;
    }
    const Body& body = bodies_[point.material];
    const double strength = body.strength * static_cast<double>(point.strengthFactor);
    const WalkMedium medium = body.model.at({point.albedo.r, point.albedo.g, point.albedo.b});
    trace::Place start = point;
    start.normal = seenFromBehind ? -point.normal : point.normal;
    glm::dvec3 direction = trace::cosineDirection(-glm::dvec3(start.normal), random);
    if (medium.refractiveIndex > 1) {
        // Refracted as it enters: the part along the surface is divided by the index.
        const glm::dvec3 normal(start.normal);
        const glm::dvec3 along = (direction - normal * glm::dot(direction, normal)) / medium.refractiveIndex;
        direction = along - normal * std::sqrt(std::max(0.0, 1 - glm::dot(along, along)));
    }
    glm::dvec3 sum(0);
    if (const std::optional<Exit> exit = walk(medium, point.material, start, direction, random, incidents)) {
        sum = strength * toVector(medium.gain) * exit->weight * light_.entering(geometry_.surfaceAt(exit->hit), random);
    }
    if (strength < 1) {
        const trace::Side side = seenFromBehind ? trace::Side::Back : trace::Side::Front;
        sum += (1 - strength) * glm::dvec3(point.albedo) * light_.irradiance(point, side, random);
    }
    return sum / walkPi;
}

bool RandomWalk::isWithin(const glm::vec3& point, trace::InstanceSet set) const {
    trace::Ray ray;
    ray.origin = point;
    ray.direction = glm::normalize(glm::vec3(0.42f, 0.83f, 0.36f)); // no mesh is likely to have an edge along it
    int depth = 0;
    while (const std::optional<trace::Hit> hit = geometry_.closest(ray, set)) {
        depth += glm::dot(geometry_.placeOf(*hit).normal, ray.direction) > 0 ? 1 : -1;
        ray.tNear = std::nextafter(hit->distance * (1 + 1e-6f), std::numeric_limits<float>::infinity());
    }
    return depth > 0;
}

/// Names of instances of other materials of which a vertex lies within the bodies of this one.
std::vector<std::string> RandomWalk::bodiesWithin(std::uint32_t material) const {
    const scene::Scene& scene = geometry_.scene();
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const scene::Mesh& mesh = scene.meshes[scene.instances[i].mesh];
        if (scene.surfaces[mesh.surface].material == material || mesh.vertices.empty()) {
            continue;
        }
        for (const std::size_t vertex : {std::size_t{0}, mesh.vertices.size() / 2, mesh.vertices.size() - 1}) {
            const glm::vec3 place(scene.instances[i].transform * glm::vec4(mesh.vertices[vertex].position, 1));
            if (isWithin(place, bodies_[material].surfaces)) {
                names.push_back(scene.instances[i].name);
                break;
            }
        }
    }
    return names;
}

std::vector<std::string> RandomWalk::warnings() const {
    std::vector<std::string> result;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        if (geometry_.scene().materials[i].diffuseTransmission > 0) {
            continue; // walls are not walked through
        }
        const std::string name = "'" + geometry_.scene().materials[i].name + "'";
        if (bodies_[i].openEdges > 0) {
            result.push_back("the bodies of " + name + " are not closed (" + std::to_string(bodies_[i].openEdges) +
                             " edges without a neighbour): light that leaves through the gaps is missing");
            continue; // within and outside mean nothing
        }
        for (const std::string& inner : bodiesWithin(i)) {
            result.push_back("'" + inner + "' reaches into a body of " + name + ": walks pass through it");
        }
        if (const double error = bodies_[i].model.profileError(); error > 0.1) {
            result.push_back("the layers of " + name +
                             " are no medium's: the walk's profile differs from theirs by up to " +
                             std::to_string(static_cast<int>(std::lround(100 * error))) + " % of the light");
        }
    }
    return result;
}

} // namespace nacre::reference
