#include "renderer/light_placement.hpp"

#include "renderer/camera.hpp"
#include "renderer/graphics_device.hpp"
#include "scene/outline.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <tuple>

namespace nacre::renderer {
namespace {

/// Texels that the shadow and thickness filters reach beyond the map's content.
constexpr float filterMargin = 6;
/// [mm] How far around a point transmit looks for where light enters, and so how far maps reach beyond their content:
/// the radius outside of which a quarter of the light leaves, of skin and more. But no farther than the content is
/// wide.
constexpr float entryMargin = 4;
/// A spot's map covers at most this half angle; a wider cone has the six maps of a point light.
constexpr float largestHalfAngle = 75 * std::numbers::pi_v<float> / 180;
/// Near plane of perspective maps over their range. Reversed 32-bit float depth is as exact at any distance from it, so
/// that it may be nearer than anything a lamp lights.
constexpr float nearToRange = 1e-8f;

using Body = LightPlacement::Body;

/// Thickness of a flat body over the scene's extent.
constexpr float flatShare = 1e-4f;
/// How many points may be looked at to find flat grounds.
constexpr std::size_t mostPointVisits = std::size_t{1} << 28;

std::vector<glm::vec3> worldPoints(const scene::Outline& outline, const scene::Instance& instance) {
    const std::span<const glm::vec3> points = outline.of(instance.mesh);
    std::vector<glm::vec3> result(points.size());
    std::ranges::transform(points, result.begin(), [&](const glm::vec3& point) { return placed(instance, point); });
    return result;
}

Interval extent(const std::vector<const Body*>& bodies, const glm::vec3& axis) {
    Interval result{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
    for (const Body* body : bodies) {
        result = body->points.extend(result, axis);
    }
    return result;
}

/// Normal of the first triangle with area of the points taken three by three from the first one; zero when there is
/// none.
glm::vec3 anyNormal(const std::vector<glm::vec3>& points) {
    for (std::size_t i = 2; i < points.size(); ++i) {
        const glm::vec3 normal = glm::cross(points[i - 1] - points[0], points[i] - points[0]);
        if (glm::length(normal) > 0) {
            return glm::normalize(normal);
        }
    }
    return glm::vec3(0);
}

/// Whether the body is flat and the whole scene lies on its lit side: a ground that shadows nothing, whose size should
/// not coarsen the map. A sheet that light shines through needs the map for itself.
bool shadowsNothing(const Body& body, const glm::vec3& direction) {
    if (body.shinesThrough) {
        return false;
    }
    if (body.normal == glm::vec3(0)) {
        return true;
    }
    if (!body.all) {
        return false;
    }
    const bool turned = glm::dot(body.normal, direction) > 0; // the lit side is the other one
    const float ownLow = turned ? -body.own.high : body.own.low;
    const float allLow = turned ? -body.all->high : body.all->low;
    const float tolerance = flatShare * std::max(body.all->length(), 1e-6f);
    return body.own.length() <= tolerance && allLow >= ownLow - tolerance;
}

/// The square seen along `direction` with the smallest side, over turns of the map about it.
struct Square {
    Axes axes;
    glm::vec2 center{0};
    float half = 0;
};

Square fitSquare(const std::vector<const Body*>& casters, const glm::vec3& direction) {
    const Axes start = axesAround(direction);
    Square best;
    constexpr int turns = 8;
    for (int turn = 0; turn < turns; ++turn) {
        const float angle = static_cast<float>(turn) * std::numbers::pi_v<float> / (2 * turns);
        const Axes axes{std::cos(angle) * start.right + std::sin(angle) * start.up,
                        std::cos(angle) * start.up - std::sin(angle) * start.right};
        const Interval x = extent(casters, axes.right);
        const Interval y = extent(casters, axes.up);
        const float half = 0.5f * std::max(x.length(), y.length());
        if (turn == 0 || half < best.half) {
            best = {axes, {x.center(), y.center()}, half};
        }
    }
    return best;
}

glm::mat4 fromRows(const glm::vec4& x, const glm::vec4& y, const glm::vec4& z, const glm::vec4& w) {
    return glm::transpose(glm::mat4(x, y, z, w));
}

glm::vec3 toVector(const float (&values)[3]) {
    return glm::make_vec3(values);
}

void copy(float (&target)[3], const glm::vec3& value) {
    std::copy_n(glm::value_ptr(value), 3, target);
}

void setShadowClip(NacreLight& light, const glm::mat4& clipFromWorld) {
    std::copy_n(glm::value_ptr(clipFromWorld), 16, light.shadowClipFromWorld);
}

/// The diagonal of the box of all points.
float sizeOf(std::span<const Body> bodies) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const Body& body : bodies) {
        for (const glm::vec3& point : body.points.points()) {
            low = glm::min(low, point);
            high = glm::max(high, point);
        }
    }
    return bodies.empty() ? 0.0f : glm::distance(low, high);
}

std::vector<const Body*> pointers(std::span<const Body> bodies) {
    std::vector<const Body*> result;
    std::ranges::transform(bodies, std::back_inserter(result), [](const Body& body) { return &body; });
    return result;
}

/// How far around its content a map reaches: a share of its half side, and scene units.
struct Rim {
    float share;
    float length;
};

void placeDirectional(NacreLight& light, std::span<const Body> bodies, const Rim& rim) {
    const glm::vec3 direction = toVector(light.direction);
    const std::vector<const Body*> all = pointers(bodies);
    std::vector<const Body*> casters;
    std::ranges::copy_if(all, std::back_inserter(casters),
                         [&](const Body* body) { return !shadowsNothing(*body, direction); });
    const Square square = fitSquare(casters.empty() ? all : casters, direction);
    const float content = square.half + std::min(rim.length, square.half);
    const float half = std::max(content * (1 + rim.share), 1e-6f);
    const Interval depth = extent(all, direction);
    const float slack = std::max(0.01f * depth.length(), 1e-6f);
    const glm::vec3 right = square.axes.right / half;
    const glm::vec3 down = -square.axes.up / half;
    const glm::vec3 origin =
        square.axes.right * square.center.x + square.axes.up * square.center.y + direction * (depth.low - slack);
    light.shadowRange = depth.length() + 2 * slack;
    const glm::vec3 along = direction / light.shadowRange;
    copy(light.position, origin);
    setShadowClip(light, fromRows({right, -glm::dot(right, origin)}, {down, -glm::dot(down, origin)},
                                  {-along, 1 + glm::dot(along, origin)}, {0, 0, 0, 1}));
}

/// Infinite reversed perspective; the axes' lengths are 1 / tan of the half angles.
glm::mat4 perspectiveFrom(const glm::vec3& position, const glm::vec3& right, const glm::vec3& down,
                          const glm::vec3& forward, float nearPlane) {
    const auto row = [&](const glm::vec3& axis) { return glm::vec4(axis, -glm::dot(axis, position)); };
    return fromRows(row(right), row(down), {0, 0, 0, nearPlane}, row(forward));
}

void placeSpot(NacreLight& light, float rim) {
    const glm::vec3 direction = toVector(light.direction);
    const Axes axes = axesAround(direction);
    const float focal = 1 / (std::tan(light.outerConeAngle) * (1 + rim));
    setShadowClip(light, perspectiveFrom(toVector(light.position), axes.right * focal, -axes.up * focal, direction,
                                         nearToRange * light.shadowRange));
}

/// Right, down and forward of the six faces, as Vulkan's cube maps have them (Vulkan 1.3, 16.5.4, "Cube Map Face
/// Selection").
constexpr std::array<std::array<glm::vec3, 3>, 6> cubeFaces{{{{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}},
                                                             {{{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}}},
                                                             {{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                                             {{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}},
                                                             {{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}},
                                                             {{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}}};

/// A little more than to the farthest vertex.
float reach(std::span<const Body> bodies, const glm::vec3& position) {
    float farthest = 0;
    for (const Body& body : bodies) {
        farthest = body.points.farthest(farthest, position);
    }
    return std::max(1.01f * farthest, 1e-6f);
}

/// Places the light's shadow map and returns its layers.
std::vector<shared::ShadowLayer> placeShadowMap(NacreLight& light, std::span<const Body> bodies, const Rim& rim) {
    if (light.kind == NACRE_LIGHT_DIRECTIONAL) {
        placeDirectional(light, bodies, rim);
    } else {
        light.shadowRange = reach(bodies, toVector(light.position));
    }
    const glm::vec4 origin(toVector(light.position), 1 / light.shadowRange);
    if (light.kind == NACRE_LIGHT_POINT) { // a cube map is seen from outside
        std::vector<shared::ShadowLayer> faces;
        for (const auto& [right, down, forward] : cubeFaces) {
            faces.push_back(
                {perspectiveFrom(toVector(light.position), right, down, forward, nearToRange * light.shadowRange),
                 origin * glm::vec4(1, 1, 1, -1), glm::vec4(0)});
        }
        return faces;
    }
    if (light.kind == NACRE_LIGHT_SPOT) {
        placeSpot(light, rim.share);
    }
    const float along = light.kind == NACRE_LIGHT_DIRECTIONAL ? 1.0f : 0.0f;
    return {{glm::make_mat4(light.shadowClipFromWorld), origin, glm::vec4(toVector(light.direction), along)}};
}

void check(const scene::Light& light) {
    const glm::vec3 sum = light.position + light.direction + light.color * light.intensity;
    if (!std::isfinite(sum.x + sum.y + sum.z)) {
        throw RendererError("the light '" + light.name + "' has a value that is not finite");
    }
    if (light.kind != scene::LightKind::Point && glm::length(light.direction) == 0) {
        throw RendererError("the light '" + light.name + "' has no direction");
    }
    if (light.kind == scene::LightKind::Spot &&
        !(light.innerConeAngle >= 0 && light.innerConeAngle <= light.outerConeAngle &&
          light.outerConeAngle <= std::numbers::pi_v<float> / 2)) {
        throw RendererError("the light '" + light.name + "' has cone angles of " +
                            std::to_string(light.innerConeAngle) + " to " + std::to_string(light.outerConeAngle) +
                            ", which must rise and lie between 0 and pi/2");
    }
}

bool sameLight(const scene::Light& a, const scene::Light& b) {
    const auto values = [](const scene::Light& light) {
        return std::tuple(light.kind, light.color, light.intensity, light.position, light.direction, light.range,
                          light.innerConeAngle, light.outerConeAngle, light.castsShadow);
    };
    return values(a) == values(b);
}

shared::LightConstants makeConstants(const NacreLight& light, float metersPerUnit) {
    // KHR_lights_punctual, "Inner and Outer Cone Angles". Without a cone the scale is 0.
    const float cosOuter = std::cos(light.outerConeAngle);
    const bool hasCone = light.kind != NACRE_LIGHT_DIRECTIONAL && light.outerConeAngle > 0;
    const float scale = hasCone ? 1 / std::max(0.001f, std::cos(light.innerConeAngle) - cosOuter) : 0.0f;
    const bool shadowed = light.shadowMap != NACRE_NO_SHADOW_MAP;
    return {.position = {toVector(light.position), light.range},
            .direction = {toVector(light.direction), light.shadowRange},
            .irradiance = {toVector(light.irradiance), metersPerUnit},
            .cone = {scale, -cosOuter * scale, 0, 0},
            .kind = {static_cast<std::uint32_t>(light.kind), shadowed ? light.shadowLayer : shared::noShadow, 0, 0},
            .shadowClipFromWorld = glm::make_mat4(light.shadowClipFromWorld)};
}

NacreLightKind convert(const scene::Light& light) {
    switch (light.kind) {
    case scene::LightKind::Spot:
        return light.outerConeAngle <= largestHalfAngle ? NACRE_LIGHT_SPOT : NACRE_LIGHT_POINT;
    case scene::LightKind::Point:
        return NACRE_LIGHT_POINT;
    case scene::LightKind::Directional:
        break;
    }
    return NACRE_LIGHT_DIRECTIONAL;
}

} // namespace

LightPlacement::LightPlacement(const scene::Scene& scene, std::uint32_t shadowMapSize)
    : metersPerUnit_(static_cast<float>(scene.metersPerUnit)),
      margin_(2 * filterMargin / static_cast<float>(std::max(shadowMapSize, 1u))) {
    const scene::Outline outline(scene);
    for (const scene::Instance& instance : scene.instances) {
        std::vector<glm::vec3> points = worldPoints(outline, instance);
        Body body;
        body.shinesThrough = scene.surfaces.at(scene.meshes.at(instance.mesh).surface).material != scene::none;
        body.normal = anyNormal(points);
        body.points = PointClusters(std::move(points));
        body.own = extent({&body}, body.normal);
        bodies_.push_back(std::move(body));
    }
    findGrounds();
    place(scene.lights);
}

/// Among very many flat bodies only the largest are looked at: a ground is large.
void LightPlacement::findGrounds() {
    const float mostThickness = 2 * flatShare * std::max(sizeOf(bodies_), 1e-6f);
    std::vector<Body*> flat;
    std::size_t points = 1;
    for (Body& body : bodies_) {
        points += body.points.points().size();
        if (body.normal != glm::vec3(0) && body.own.length() <= mostThickness) {
            flat.push_back(&body);
        }
    }
    const std::size_t count = std::min(flat.size(), std::max<std::size_t>(mostPointVisits / points, 1));
    const auto size = [](const Body* body) { return sizeOf({body, 1}); };
    if (count < flat.size()) {
        std::ranges::nth_element(flat, flat.begin() + static_cast<std::ptrdiff_t>(count), std::ranges::greater(), size);
    }
    const std::vector<const Body*> all = pointers(bodies_);
    for (std::size_t i = 0; i < count; ++i) {
        flat[i]->all = extent(all, flat[i]->normal);
    }
}

LightPlacement::Placed LightPlacement::placeAnew(const scene::Light& light) const {
    check(light);
    Placed result{.source = light, .light = {}, .layers = {}};
    NacreLight& placed = result.light;
    placed.kind = convert(light);
    copy(placed.position, light.position);
    copy(placed.direction,
         light.kind == scene::LightKind::Point ? glm::vec3(0, -1, 0) : glm::normalize(light.direction));
    copy(placed.irradiance, light.color * light.intensity);
    placed.range = light.range / metersPerUnit_;
    if (light.kind == scene::LightKind::Spot) {
        placed.innerConeAngle = light.innerConeAngle;
        placed.outerConeAngle = light.outerConeAngle;
    }
    placed.shadowMap = NACRE_NO_SHADOW_MAP;
    placed.shadowRange = 1;
    setShadowClip(placed, glm::mat4(1));
    if (light.castsShadow) {
        placed.shadowMap = 0;
        result.layers = placeShadowMap(placed, bodies_, {margin_, 1e-3f * entryMargin / metersPerUnit_});
    }
    return result;
}

LightSet LightPlacement::gather(const std::vector<Placed>& placed) const {
    LightSet result;
    for (const Placed& one : placed) {
        NacreLight& light = result.lights.emplace_back(one.light);
        light.shadowLayer = one.layers.empty() ? 0 : static_cast<std::uint32_t>(result.shadowLayers.size());
        result.constants.push_back(makeConstants(light, metersPerUnit_));
        result.shadowLayers.insert(result.shadowLayers.end(), one.layers.begin(), one.layers.end());
    }
    return result;
}

void LightPlacement::limit(std::size_t lights, std::size_t shadowLayers) {
    mostLights_ = lights;
    mostShadowLayers_ = shadowLayers;
}

void LightPlacement::place(std::span<const scene::Light> lights) {
    if (lights.size() > maxLights) {
        throw RendererError("the scene has " + std::to_string(lights.size()) + " lights, and may have at most " +
                            std::to_string(maxLights));
    }
    std::vector<Placed> placed;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const bool known = i < placed_.size() && sameLight(placed_[i].source, lights[i]);
        placed.push_back(known ? placed_[i] : placeAnew(lights[i]));
    }
    LightSet set = gather(placed);
    if (set.lights.size() > mostLights_ || set.shadowLayers.size() > mostShadowLayers_) {
        throw RendererError("the frame was made for " + std::to_string(mostLights_) + " lights with " +
                            std::to_string(mostShadowLayers_) + " layers of shadow maps, and cannot get " +
                            std::to_string(set.lights.size()) + " with " + std::to_string(set.shadowLayers.size()));
    }
    placed_ = std::move(placed);
    set_ = std::move(set);
}

} // namespace nacre::renderer
