#include "bench/effect/transmit_scene.hpp"

#include "bench/synthetic/vector3.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

namespace nacre::bench {
namespace {

using Vector = Vector3<float>;

constexpr float middle = 400; // mm before the camera
constexpr float wall = 480;
constexpr float halfHeight = 75; // mm in the picture at `middle`
constexpr float range = 1000;

struct Ray {
    Vector origin, direction; // of unit length
};

struct Bodies {
    std::vector<Vector> centers;
    float radius = 0;

    /// The distance along the ray to the first sphere, `index` of which is given, or to `range`.
    float distance(const Ray& ray, int* index = nullptr) const {
        float nearest = range;
        for (std::size_t i = 0; i < centers.size(); ++i) {
            const Vector offset = centers[i] - ray.origin;
            const float along = dot(offset, ray.direction);
            const float inside = radius * radius - dot(offset, offset) + along * along;
            const float distance = inside < 0 ? range : along - std::sqrt(inside);
            if (distance > 0 && distance < nearest) {
                nearest = distance;
                if (index) {
                    *index = static_cast<int>(i);
                }
            }
        }
        return nearest;
    }
};

/// Calls row(0) … row(count - 1) on all processors.
template <typename Row> void forRows(std::uint32_t count, const Row& row) {
    const std::uint32_t threadCount = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> threads;
    for (std::uint32_t thread = 0; thread < threadCount; ++thread) {
        threads.emplace_back([=, &row] {
            for (std::uint32_t i = thread; i < count; i += threadCount) {
                row(i);
            }
        });
    }
}

Bodies makeBodies(VkExtent2D extent, double coverage) {
    const float halfWidth = halfHeight * static_cast<float>(extent.width) / static_cast<float>(extent.height);
    Bodies bodies;
    bodies.radius =
        static_cast<float>(std::sqrt(coverage * 4 * halfWidth * halfHeight / (15 * std::numbers::pi_v<double>)));
    for (int i = 0; i < 15; ++i) {
        const int column = i % 5 - 2;
        const int row = i / 5 - 1;
        bodies.centers.push_back(
            {halfWidth * 0.4f * static_cast<float>(column), halfHeight * 0.66f * static_cast<float>(row), -middle});
    }
    return bodies;
}

// What the camera sees of the bodies, and of the wall behind them.
struct SphereBuffers {
    double focalLength = 0;
    std::vector<float> depth;
    std::vector<std::uint16_t> ids;
    std::vector<Rgb> normals;
};

SphereBuffers traceCamera(const Bodies& bodies, VkExtent2D extent) {
    const float focalLength = 0.5f * static_cast<float>(extent.height) * middle / halfHeight;
    const std::size_t count = std::size_t{extent.width} * extent.height;
    SphereBuffers buffers{focalLength, std::vector<float>(count, wall), std::vector<std::uint16_t>(count),
                          std::vector<Rgb>(count, Rgb{0, 0, 1})};
    forRows(extent.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const Vector direction = normalized(
                Vector{(static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(extent.width)) / focalLength,
                       (0.5f * static_cast<float>(extent.height) - static_cast<float>(y) - 0.5f) / focalLength, -1});
            int body = -1;
            const float distance = bodies.distance({{}, direction}, &body);
            const std::size_t i = std::size_t{y} * extent.width + x;
            if (body >= 0) {
                const Vector point = distance * direction;
                const Vector normal = normalized(point - bodies.centers[static_cast<std::size_t>(body)]);
                buffers.ids[i] = 1;
                buffers.depth[i] = -point[2];
                buffers.normals[i] = {normal[0], normal[1], normal[2]};
            }
        }
    });
    return buffers;
}

NacreLight makeLight(NacreLightKind kind, const Vector& position, const Vector& target, std::uint32_t index) {
    constexpr float reach = 160; // mm around the target
    NacreLight light{};
    light.kind = kind;
    const Vector direction = normalized(target - position);
    const Vector right = normalized(cross(direction, {0, 1, 0}));
    const Vector up = cross(right, direction);
    const float distance = std::sqrt(dot(target - position, target - position));
    for (std::size_t i = 0; i < 3; ++i) {
        light.position[i] = position[i];
        light.direction[i] = direction[i];
        light.irradiance[i] = 1;
        light.shadowClipFromWorld[4 * i] = right[i] / reach;
        light.shadowClipFromWorld[4 * i + 1] = up[i] / reach;
        light.shadowClipFromWorld[4 * i + 3] = kind == NACRE_LIGHT_SPOT ? direction[i] / distance : 0;
    }
    light.shadowClipFromWorld[12] = -dot(right, position) / reach;
    light.shadowClipFromWorld[13] = -dot(up, position) / reach;
    light.shadowClipFromWorld[15] = kind == NACRE_LIGHT_SPOT ? -dot(direction, position) / distance : 1;
    light.outerConeAngle = 0.7f;
    light.innerConeAngle = 0.6f;
    light.shadowMap = index;
    light.shadowRange = range;
    return light;
}

/// The ray through a map's point s, t in [-1, 1]; the inverse of the light's projection, or of the cube map's faces.
Ray shadowRay(const NacreLight& light, std::uint32_t face, float s, float t) {
    const auto row = [&](int index) {
        const float* m = light.shadowClipFromWorld + index;
        return Vector{m[0], m[4], m[8]};
    };
    const Vector position{light.position[0], light.position[1], light.position[2]};
    const Vector direction{light.direction[0], light.direction[1], light.direction[2]};
    const auto across = [&](int index) { return 1 / dot(row(index), row(index)) * row(index); };
    switch (light.kind) {
    case NACRE_LIGHT_DIRECTIONAL:
        return {position + s * across(0) + t * across(1), direction};
    case NACRE_LIGHT_SPOT:
        return {position, normalized(s * across(0) + t * across(1) + across(3))};
    default:
        const Vector directions[] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
        return {position, normalized(directions[face])};
    }
}

std::vector<float> traceShadowMap(const Bodies& bodies, const NacreLight& light, std::uint32_t size) {
    const std::uint32_t layers = light.kind == NACRE_LIGHT_POINT ? 6 : 1;
    std::vector<float> texels(std::size_t{layers} * size * size);
    const auto coordinate = [&](std::uint32_t texel) {
        return (2 * static_cast<float>(texel) + 1) / static_cast<float>(size) - 1;
    };
    forRows(layers * size, [&](std::uint32_t row) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const Ray ray = shadowRay(light, row / size, coordinate(x), coordinate(row % size));
            texels[std::size_t{row} * size + x] = bodies.distance(ray) / range;
        }
    });
    return texels;
}

} // namespace

TransmitScene::TransmitScene(renderer::Gpu& gpu, VkExtent2D extent, double coverage, std::uint32_t shadowMapSize)
    : images_(gpu, extent) {
    const Bodies bodies = makeBodies(extent, coverage);
    const SphereBuffers buffers = traceCamera(bodies, extent);
    info.view = perspectiveView(extent, buffers.focalLength);
    info.depth = effectImage(images_.addDepth(buffers.depth));
    info.materialId = effectImage(images_.addIds(vk::Format::eR8Uint, buffers.ids));
    info.normal = effectImage(images_.addLight("normals", vk::Format::eR16G16B16A16Sfloat, buffers.normals));
    info.transmitted = effectImage(images_.addOutput("transmitted", vk::Format::eR16G16B16A16Sfloat));
    const Vector target{0, 0, -middle};
    lights_ = {makeLight(NACRE_LIGHT_DIRECTIONAL, {-250, 150, -650}, target, 0),
               makeLight(NACRE_LIGHT_SPOT, {200, 200, -700}, target, 1),
               makeLight(NACRE_LIGHT_POINT, {20, -120, -420}, target, 2)};
    for (const NacreLight& light : lights_) {
        shadowMaps_.push_back(
            effectImage(images_.addShadowMap(shadowMapSize, traceShadowMap(bodies, light, shadowMapSize))));
    }
    info.lightCount = static_cast<std::uint32_t>(lights_.size());
    info.lights = lights_.data();
    info.shadowMapCount = static_cast<std::uint32_t>(shadowMaps_.size());
    info.shadowMaps = shadowMaps_.data();
}

} // namespace nacre::bench
