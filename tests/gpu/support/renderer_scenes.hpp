// Small scenes whose light is known in closed form, and one device for all renderer tests of a program.
#pragma once

#include "renderer/offscreen.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nacre::tests {

inline constexpr float pi = std::numbers::pi_v<float>;

/// The device of all tests in one program, under validation; every message so far fails the test that looks.
inline renderer::Device& device() {
    static renderer::Device instance({.validation = true});
    return instance;
}

/// Fails when the validation layer has said anything during the test.
class RendererTest : public ::testing::Test {
protected:
    void TearDown() override {
        const std::vector<std::string>& messages = device().validationMessages();
        for (std::size_t i = before_; i < messages.size(); ++i) {
            ADD_FAILURE() << messages[i];
        }
    }

private:
    std::size_t before_ = device().validationMessages().size();
};

/// Adds a mesh with its own surface and one instance; returns the surface.
inline scene::Surface& add(scene::Scene& scene, scene::Mesh mesh, const glm::mat4& transform = glm::mat4(1)) {
    mesh.surface = static_cast<std::uint32_t>(scene.surfaces.size());
    scene.instances.push_back({mesh.name, static_cast<std::uint32_t>(scene.meshes.size()), transform});
    scene.meshes.push_back(std::move(mesh));
    return scene.surfaces.emplace_back();
}

/// A square in the xy plane around the origin that faces +Z, `cells` squares a side.
inline scene::Mesh square(float side, std::uint32_t cells = 1) {
    scene::Mesh mesh{.name = "square"};
    for (std::uint32_t y = 0; y <= cells; ++y) {
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const glm::vec2 uv = glm::vec2(x, y) / static_cast<float>(cells);
            mesh.vertices.push_back(
                {{side * (uv.x - 0.5f), side * (uv.y - 0.5f), 0}, {0, 0, 1}, {1, 0, 0, 1}, {uv.x, 1 - uv.y}});
        }
    }
    for (std::uint32_t y = 0; y < cells; ++y) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = y * (cells + 1) + x;
            const std::uint32_t b = a + cells + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }
    return mesh;
}

inline scene::Mesh sphere(float radius, std::uint32_t rings) {
    scene::Mesh mesh{.name = "sphere"};
    const std::uint32_t sectors = 2 * rings;
    for (std::uint32_t i = 0; i <= rings; ++i) {
        for (std::uint32_t j = 0; j <= sectors; ++j) {
            const float theta = pi * static_cast<float>(i) / static_cast<float>(rings);
            const float phi = 2 * pi * static_cast<float>(j) / static_cast<float>(sectors);
            const glm::vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            mesh.vertices.push_back({radius * n, n, {std::cos(phi), 0, -std::sin(phi), 1}, {}});
        }
    }
    for (std::uint32_t i = 0; i < rings; ++i) {
        for (std::uint32_t j = 0; j < sectors; ++j) {
            const std::uint32_t a = i * (sectors + 1) + j;
            const std::uint32_t b = a + sectors + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
    return mesh;
}

/// A box of these side lengths around the origin.
inline scene::Mesh box(const glm::vec3& size) {
    scene::Mesh mesh{.name = "box"};
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 normal(0);
            normal[axis] = sign;
            glm::vec3 u(0);
            u[(axis + 1) % 3] = 1;
            const glm::vec3 v = glm::cross(normal, u);
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                mesh.vertices.push_back(
                    {0.5f * size * (normal + corner.x * u + corner.y * v), normal, {u, 1}, 0.5f * corner + 0.5f});
            }
            for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) {
                mesh.indices.push_back(first + index);
            }
        }
    }
    return mesh;
}

/// A scene without any light, seen from +Z.
inline scene::Scene darkScene(float cameraDistance) {
    scene::Scene scene{.name = "test"};
    scene.environment.intensity = 0;
    scene.cameras.push_back({.name = "camera", .position = {0, 0, cameraDistance}});
    return scene;
}

inline scene::Light directional(const glm::vec3& direction, float intensity = 1) {
    return {.name = "sun", .kind = scene::LightKind::Directional, .intensity = intensity, .direction = direction};
}

inline scene::Light spot(const glm::vec3& position, const glm::vec3& direction, float intensity = 1) {
    return {.name = "spot",
            .kind = scene::LightKind::Spot,
            .intensity = intensity,
            .position = position,
            .direction = direction,
            .innerConeAngle = 0.3f,
            .outerConeAngle = 0.5f};
}

inline scene::Light point(const glm::vec3& position, float intensity = 1) {
    return {.name = "point", .kind = scene::LightKind::Point, .intensity = intensity, .position = position};
}

/// 160 by 90 pixels, small shadow maps, no effect.
inline renderer::RenderSettings plainSettings() {
    renderer::RenderSettings settings;
    settings.width = 160;
    settings.height = 90;
    settings.shadowMapSize = 512;
    settings.scatter = settings.transmit = false;
    return settings;
}

inline float at(const renderer::Pixels& pixels, std::uint32_t x, std::uint32_t y, std::size_t channel = 0) {
    return pixels.values[(std::size_t{y} * pixels.width + x) * pixels.channels.size() + channel];
}

/// Renders from the first camera.
inline renderer::Offscreen render(const scene::Scene& scene, const renderer::RenderSettings& settings) {
    renderer::Offscreen result(device(), scene, settings);
    result.render(scene.cameras.at(0));
    return result;
}

/// Where the view ray through a pixel's centre meets the plane z = `plane`.
inline glm::vec3 onPlane(const scene::Camera& camera, const renderer::Pixels& pixels, std::uint32_t x, std::uint32_t y,
                         float plane) {
    const float width = static_cast<float>(pixels.width);
    const float height = static_cast<float>(pixels.height);
    const glm::vec2 ndc((2 * (static_cast<float>(x) + 0.5f) / width - 1) * width / height,
                        1 - 2 * (static_cast<float>(y) + 0.5f) / height);
    const float reach = std::tan(camera.verticalFieldOfView / 2) * (camera.position.z - plane);
    return {camera.position.x + ndc.x * reach, camera.position.y + ndc.y * reach, plane};
}

} // namespace nacre::tests
