#include "renderer/light_placement.hpp"

#include "renderer/camera.hpp"
#include "renderer/graphics_device.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

namespace nacre::renderer {
namespace {

/// Texels that the shadow and thickness filters reach beyond the map's content.
constexpr float filterMargin = 6;
/// A spot's map covers at most this half angle; a wider cone stays unshadowed at its rim.
constexpr float largestHalfAngle = 85 * std::numbers::pi_v<float> / 180;
/// Near plane of perspective maps over their range; the depth is reversed 32-bit float, so it may be small.
constexpr float nearToRange = 1e-4f;

using Points = std::vector<glm::vec3>;

Points worldPoints(const scene::Scene& scene, const scene::Instance& instance) {
    Points points;
    for (const scene::Vertex& vertex : scene.meshes.at(instance.mesh).vertices) {
        points.emplace_back(instance.transform * glm::vec4(vertex.position, 1));
    }
    return points;
}

struct Interval {
    float low = std::numeric_limits<float>::max();
    float high = std::numeric_limits<float>::lowest();
    void add(float value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    float length() const { return high - low; }
    float center() const { return 0.5f * (low + high); }
};

Interval extent(std::span<const Points> instances, const glm::vec3& axis) {
    Interval result;
    for (const Points& points : instances) {
        for (const glm::vec3& point : points) {
            result.add(glm::dot(axis, point));
        }
    }
    return result;
}

/// Normal of the first triangle with area of the points taken three by three from the first one; zero when there is
/// none.
glm::vec3 anyNormal(const Points& points) {
    for (std::size_t i = 2; i < points.size(); ++i) {
        const glm::vec3 normal = glm::cross(points[i - 1] - points[0], points[i] - points[0]);
        if (glm::length(normal) > 0) {
            return glm::normalize(normal);
        }
    }
    return glm::vec3(0);
}

/// Whether the instance is flat and the whole scene lies on its lit side: a ground that shadows nothing, whose size
/// should not coarsen the map.
bool shadowsNothing(std::span<const Points> instances, const Points& points, const glm::vec3& direction) {
    glm::vec3 normal = anyNormal(points);
    if (normal == glm::vec3(0)) {
        return true;
    }
    normal = glm::dot(normal, direction) > 0 ? -normal : normal;
    const Interval own = extent({&points, 1}, normal);
    const Interval all = extent(instances, normal);
    const float tolerance = 1e-4f * std::max(all.length(), 1e-6f);
    return own.length() <= tolerance && all.low >= own.low - tolerance;
}

/// The square seen along `direction` with the smallest side, over turns of the map about it.
struct Square {
    Axes axes;
    glm::vec2 center{0};
    float half = 0;
};

Square fitSquare(std::span<const Points> casters, const glm::vec3& direction) {
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

void placeDirectional(PlacedLight& light, std::span<const Points> instances, float rim) {
    std::vector<Points> casters;
    std::copy_if(instances.begin(), instances.end(), std::back_inserter(casters),
                 [&](const Points& points) { return !shadowsNothing(instances, points, light.direction); });
    const Square square = fitSquare(casters.empty() ? instances : std::span<const Points>(casters), light.direction);
    const float half = std::max(square.half * (1 + rim), 1e-6f);
    const Interval depth = extent(instances, light.direction);
    const float slack = std::max(0.01f * depth.length(), 1e-6f);
    const glm::vec3 right = square.axes.right / half;
    const glm::vec3 down = -square.axes.up / half;
    light.position =
        square.axes.right * square.center.x + square.axes.up * square.center.y + light.direction * (depth.low - slack);
    light.shadowRange = depth.length() + 2 * slack;
    const glm::vec3 along = light.direction / light.shadowRange;
    light.shadowClipFromWorld =
        fromRows({right, -glm::dot(right, light.position)}, {down, -glm::dot(down, light.position)},
                 {-along, 1 + glm::dot(along, light.position)}, {0, 0, 0, 1});
}

/// Infinite reversed perspective; the axes' lengths are 1 / tan of the half angles.
glm::mat4 perspectiveFrom(const glm::vec3& position, const glm::vec3& right, const glm::vec3& down,
                          const glm::vec3& forward, float nearPlane) {
    const auto row = [&](const glm::vec3& axis) { return glm::vec4(axis, -glm::dot(axis, position)); };
    return fromRows(row(right), row(down), {0, 0, 0, nearPlane}, row(forward));
}

void placeSpot(PlacedLight& light, float rim) {
    const Axes axes = axesAround(light.direction);
    const float focal = 1 / (std::tan(std::min(light.outerConeAngle, largestHalfAngle)) * (1 + rim));
    light.shadowClipFromWorld = perspectiveFrom(light.position, axes.right * focal, -axes.up * focal, light.direction,
                                                nearToRange * light.shadowRange);
}

/// Right, down and forward of the six faces, as Vulkan's cube maps have them (Vulkan 1.3, 16.5.4, "Cube Map Face
/// Selection").
constexpr std::array<std::array<glm::vec3, 3>, 6> cubeFaces{{{{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}},
                                                             {{{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}}},
                                                             {{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                                             {{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}},
                                                             {{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}},
                                                             {{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}}};

void addShadowLayers(LightSet& set, PlacedLight& light, std::span<const Points> instances, float rim) {
    light.shadowLayer = static_cast<std::uint32_t>(set.shadowLayers.size());
    if (light.kind == scene::LightKind::Directional) {
        placeDirectional(light, instances, rim);
    } else {
        float farthest = 0;
        for (const Points& points : instances) {
            for (const glm::vec3& point : points) {
                farthest = std::max(farthest, glm::distance(point, light.position));
            }
        }
        light.shadowRange = std::max(1.01f * farthest, 1e-6f);
    }
    const glm::vec4 origin(light.position, 1 / light.shadowRange);
    if (light.kind == scene::LightKind::Point) {
        for (const auto& [right, down, forward] : cubeFaces) {
            set.shadowLayers.push_back(
                {perspectiveFrom(light.position, right, down, forward, nearToRange * light.shadowRange), origin,
                 glm::vec4(0)});
        }
        return;
    }
    if (light.kind == scene::LightKind::Spot) {
        placeSpot(light, rim);
    }
    const float along = light.kind == scene::LightKind::Directional ? 1.0f : 0.0f;
    set.shadowLayers.push_back({light.shadowClipFromWorld, origin, glm::vec4(light.direction, along)});
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

} // namespace

LightSet placeLights(const scene::Scene& scene, std::uint32_t shadowMapSize) {
    if (scene.lights.size() > maxLights) {
        throw RendererError("the scene has " + std::to_string(scene.lights.size()) + " lights, and may have at most " +
                            std::to_string(maxLights));
    }
    std::vector<Points> instances;
    for (const scene::Instance& instance : scene.instances) {
        instances.push_back(worldPoints(scene, instance));
    }
    const float rim = 2 * filterMargin / static_cast<float>(std::max(shadowMapSize, 1u));
    LightSet set;
    for (const scene::Light& light : scene.lights) {
        check(light);
        PlacedLight placed;
        placed.kind = light.kind;
        placed.position = light.position;
        placed.direction =
            light.kind == scene::LightKind::Point ? glm::vec3(0, -1, 0) : glm::normalize(light.direction);
        placed.irradiance = light.color * light.intensity;
        placed.range = light.range / static_cast<float>(scene.metersPerUnit);
        placed.innerConeAngle = light.innerConeAngle;
        placed.outerConeAngle = light.outerConeAngle;
        if (light.castsShadow) {
            addShadowLayers(set, placed, instances, rim);
        }
        set.lights.push_back(placed);
    }
    return set;
}

shared::LightConstants makeConstants(const PlacedLight& light, float metersPerUnit) {
    // KHR_lights_punctual, "Inner and Outer Cone Angles".
    const float cosOuter = std::cos(light.outerConeAngle);
    const float scale = 1 / std::max(0.001f, std::cos(light.innerConeAngle) - cosOuter);
    return {.position = {light.position, light.range * metersPerUnit},
            .direction = {light.direction, light.shadowRange},
            .irradiance = {light.irradiance, metersPerUnit},
            .cone = {scale, -cosOuter * scale, 0, 0},
            .kind = {static_cast<std::uint32_t>(light.kind), light.shadowLayer, 0, 0},
            .shadowClipFromWorld = light.shadowClipFromWorld};
}

} // namespace nacre::renderer
