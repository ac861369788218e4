// Light against closed forms: punctual lights and the environment on planes and spheres, shadows, no acne.
#include "tests/gpu/support/renderer_scenes.hpp"

#include "nacre/presets.hpp"
#include "renderer/point_clusters.hpp"

#include <random>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class Lighting : public RendererTest {};

/// KHR_lights_punctual by hand.
float expectedIrradiance(const scene::Light& light, const glm::vec3& position, const glm::vec3& normal) {
    if (light.kind == scene::LightKind::Directional) {
        return light.intensity * std::max(0.0f, -glm::dot(normal, glm::normalize(light.direction)));
    }
    const glm::vec3 offset = light.position - position;
    const float distance = glm::length(offset);
    const glm::vec3 toLight = offset / distance;
    float cone = 1;
    if (light.kind == scene::LightKind::Spot) {
        const float cosine = -glm::dot(glm::normalize(light.direction), toLight);
        const float inner = std::cos(light.innerConeAngle);
        const float outer = std::cos(light.outerConeAngle);
        cone = std::clamp((cosine - outer) / (inner - outer), 0.0f, 1.0f);
    }
    const float ratio = light.range > 0 ? distance / light.range : 0;
    return light.intensity * cone * cone * std::clamp(1 - std::pow(ratio, 4.0f), 0.0f, 1.0f) *
           std::max(0.0f, glm::dot(normal, toLight)) / (distance * distance);
}

void expectOnPlane(const scene::Light& light) {
    scene::Scene scene = darkScene(2);
    add(scene, square(3));
    scene.lights.push_back(light);
    const renderer::Offscreen renderer = render(scene, plainSettings());
    const Pixels irradiance = renderer.read(Output::Irradiance);
    for (std::uint32_t y = 3; y < irradiance.height; y += 7) {
        for (std::uint32_t x = 3; x < irradiance.width; x += 7) {
            const glm::vec3 position = onPlane(scene.cameras[0], irradiance, x, y, 0);
            const float expected = expectedIrradiance(light, position, {0, 0, 1});
            ASSERT_NEAR(at(irradiance, x, y), expected, 2e-3f * expected + 2e-4f) << x << ", " << y;
        }
    }
}

TEST_F(Lighting, DirectionalLightOnAPlane) {
    expectOnPlane(directional({0.4f, -0.3f, -1}, 2));
}

TEST_F(Lighting, SpotLightOnAPlane) {
    expectOnPlane(spot({0.3f, 0.2f, 1}, {-0.2f, -0.1f, -1}, 3));
}

TEST_F(Lighting, PointLightOnAPlane) {
    expectOnPlane(point({-0.3f, 0.4f, 0.8f}, 3));
}

TEST_F(Lighting, RangeEndsAPointLight) {
    scene::Light light = point({0, 0, 0.5f}, 1);
    light.range = 0.7f;
    expectOnPlane(light);
}

TEST_F(Lighting, UnitsScaleDistances) {
    scene::Scene scene = darkScene(2000);
    scene.metersPerUnit = 1e-3;
    add(scene, square(3000));
    scene.lights.push_back(point({0, 0, 500}, 1));
    const renderer::Offscreen renderer = render(scene, plainSettings());
    const Pixels irradiance = renderer.read(Output::Irradiance);
    const glm::vec3 position = 1e-3f * onPlane(scene.cameras[0], irradiance, 80, 45, 0);
    const float expected = expectedIrradiance(point({0, 0, 0.5f}, 1), position, {0, 0, 1});
    EXPECT_NEAR(at(irradiance, 80, 45), expected, 2e-3f * expected);
}

TEST_F(Lighting, UniformSurroundingsGivePiTimesTheirRadiance) {
    scene::Scene scene = darkScene(2);
    add(scene, square(3));
    scene.environment.intensity = 2;
    scene.environment.image = nacre::Image{64, 32, {"R", "G", "B", "A"}, std::vector<float>(64 * 32 * 4, 0.25f)};
    const renderer::Offscreen renderer = render(scene, plainSettings());
    const Pixels irradiance = renderer.read(Output::Irradiance);
    for (const std::uint32_t x : {10u, 80u, 150u}) {
        EXPECT_NEAR(at(irradiance, x, 45), pi * 0.5f, 0.01f * pi * 0.5f);
    }
}

TEST_F(Lighting, WhiteMetalInUniformSurroundingsReflectsThem) {
    scene::Scene scene = darkScene(2);
    scene::Surface& surface = add(scene, square(3));
    surface.baseColor = glm::vec4(1);
    surface.metallic = 1;
    surface.roughness = 0.2f;
    scene.environment.image = nacre::Image{64, 32, {"R", "G", "B", "A"}, std::vector<float>(64 * 32 * 4, 0.5f)};
    scene.environment.intensity = 1;
    const renderer::Offscreen renderer = render(scene, plainSettings());
    EXPECT_NEAR(at(renderer.read(Output::Specular), 80, 45), 0.5f, 0.01f);
    EXPECT_EQ(at(renderer.read(Output::Albedo), 80, 45), 0);
}

/// A small square stands between the light and the plane: the plane's middle is dark, its rim is lit.
void expectShadow(const scene::Light& light) {
    scene::Scene scene = darkScene(2);
    add(scene, square(3));
    add(scene, square(0.2f), glm::translate(glm::mat4(1), {0, 0, 0.4f})).doubleSided = true;
    scene.lights.push_back(light);
    scene.cameras[0].position = {0, -1.5f, 1.5f};
    scene.cameras[0].target = {0, 0, 0};
    const renderer::Offscreen renderer = render(scene, plainSettings());
    const Pixels irradiance = renderer.read(Output::Irradiance);
    // The camera looks at the origin, which the small square keeps dark; it does not hide it.
    EXPECT_EQ(at(irradiance, 80, 45), 0);
    const float expected = expectedIrradiance(light, {0, 0, 0}, {0, 0, 1});
    EXPECT_GT(at(irradiance, 55, 45), 0.2f * expected);

    scene.lights[0].castsShadow = false;
    const Pixels open = render(scene, plainSettings()).read(Output::Irradiance);
    EXPECT_NEAR(at(open, 80, 45), expected, 0.01f * expected);
}

TEST_F(Lighting, DirectionalShadow) {
    expectShadow(directional({0, 0, -1}));
}

TEST_F(Lighting, SpotShadow) {
    expectShadow(spot({0, 0, 1}, {0, 0, -1}));
}

TEST_F(Lighting, PointShadow) {
    expectShadow(point({0, 0, 0.9f}));
}

TEST_F(Lighting, HolesOfAnAlphaMaskLetLightThrough) {
    scene::Scene scene = darkScene(2);
    add(scene, square(3));
    scene::Surface& blind = add(scene, square(0.4f), glm::translate(glm::mat4(1), {0, 0, 0.4f}));
    blind.doubleSided = true;
    blind.alphaMode = scene::AlphaMode::Mask;
    blind.baseColorTexture = 0;
    // Left half opaque, right half a hole.
    scene.textures.push_back(
        {.name = "mask", .width = 2, .height = 1, .pixels = {255, 255, 255, 255, 255, 255, 255, 0}});
    scene.textures.back().wrapU = scene.textures.back().wrapV = scene::Wrap::Clamp;
    scene.lights.push_back(directional({0, 0, -1}));
    scene.cameras[0].position = {0, -1.5f, 1.5f};
    const Pixels irradiance = render(scene, plainSettings()).read(Output::Irradiance);
    EXPECT_EQ(at(irradiance, 75, 45), 0);
    EXPECT_NEAR(at(irradiance, 85, 45), 1, 1e-3f);
}

/// A sphere's lit side is N·L everywhere the light is not grazing, and its dark side is dark.
void expectNoAcne(const scene::Light& light) {
    scene::Scene scene = darkScene(3);
    add(scene, sphere(0.5f, 64));
    add(scene, square(3, 4), glm::translate(glm::mat4(1), {0, 0, -0.5f}));
    scene.lights.push_back(light);
    renderer::RenderSettings settings = plainSettings();
    settings.shadowMapSize = 1024;
    const renderer::Offscreen renderer = render(scene, settings);
    const Pixels irradiance = renderer.read(Output::Irradiance);
    const Pixels depth = renderer.read(Output::Depth);
    const Pixels normal = renderer.read(Output::Normal);
    int checked = 0;
    for (std::uint32_t y = 0; y < depth.height; ++y) {
        for (std::uint32_t x = 0; x < depth.width; ++x) {
            const glm::vec3 position = onPlane(scene.cameras[0], depth, x, y, 3 - at(depth, x, y));
            if (std::abs(glm::length(position) - 0.5f) > 2e-3f || position.z < -0.3f) {
                continue;
            }
            const glm::vec3 n(at(normal, x, y, 0), at(normal, x, y, 1), at(normal, x, y, 2));
            const glm::vec3 toLight = light.kind == scene::LightKind::Directional
                                          ? -glm::normalize(light.direction)
                                          : glm::normalize(light.position - position);
            const float expected = expectedIrradiance(light, position, n);
            const float grazing = glm::dot(n, toLight);
            if (grazing > 0.1f) {
                ASSERT_NEAR(at(irradiance, x, y), expected, 0.01f * expected + 1e-3f) << x << ", " << y;
                ++checked;
            } else if (grazing < -0.02f) {
                ASSERT_EQ(at(irradiance, x, y), 0) << x << ", " << y;
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 300);
}

TEST_F(Lighting, NoAcneUnderADirectionalLight) {
    expectNoAcne(directional({-1, -0.8f, -0.6f}));
}

TEST_F(Lighting, NoAcneUnderASpotLight) {
    scene::Light light = spot({2, 1, 1}, {-2, -1, -1}, 4);
    light.outerConeAngle = 0.6f;
    light.innerConeAngle = 0.5f;
    expectNoAcne(light);
}

TEST_F(Lighting, NoAcneUnderAPointLight) {
    expectNoAcne(point({1.2f, 0.9f, 0.7f}, 2));
}

/// Specular light of a ball under a light and surroundings.
Pixels specularOfBall(float roughness, double secondLobe, double secondLobeRoughness) {
    scene::Scene scene = darkScene(3);
    scene.environment.intensity = 1;
    scene.materials = {presets().front()};
    scene.materials[0].secondLobe = secondLobe;
    scene.materials[0].secondLobeRoughness = secondLobeRoughness;
    scene::Surface& surface = add(scene, sphere(0.5f, 16));
    surface.material = 0;
    surface.roughness = roughness;
    scene.lights = {directional({0.3f, -0.4f, -1}, 3)};
    renderer::RenderSettings settings = plainSettings();
    settings.width = settings.height = 64;
    return render(scene, settings).read(Output::Specular);
}

TEST_F(Lighting, TwoLobesAreMixed) {
    const Pixels one = specularOfBall(0.4f, 0, 1);
    const Pixels other = specularOfBall(0.4f * 1.5f, 0, 1);
    EXPECT_EQ(specularOfBall(0.4f, 0, 1.5).values, one.values) << "a lobe without a share changes something";
    const Pixels second = specularOfBall(0.4f, 1, 1.5);
    const Pixels mixed = specularOfBall(0.4f, 0.25, 1.5);
    float most = 0;
    for (std::size_t i = 0; i < one.values.size(); ++i) {
        const float tolerance = 2e-3f * std::max(1.0f, other.values[i]); // roughness and light are half floats
        ASSERT_NEAR(second.values[i], other.values[i], 4 * tolerance) << i;
        ASSERT_NEAR(mixed.values[i], 0.75f * one.values[i] + 0.25f * second.values[i], tolerance) << i;
        most = std::max(most, std::abs(one.values[i] - second.values[i]));
    }
    EXPECT_GT(most, 0.05f);
}

TEST(PointClusters, ReachAsFarAsAllTheirPoints) {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    const auto vector = [&] { return glm::vec3(normal(random), normal(random), normal(random)); };
    for (const std::size_t count : {0u, 1u, 64u, 65u, 5000u}) {
        std::vector<glm::vec3> points(count);
        for (glm::vec3& point : points) {
            point = glm::vec3(3, 0.1f, 1) * vector() + glm::vec3(20, 0, -5);
        }
        const renderer::PointClusters clusters{std::vector(points)};
        for (int i = 0; i < 50; ++i) {
            const glm::vec3 axis = vector();
            renderer::Interval expected{1, -1};
            float farthest = 0.5f;
            for (const glm::vec3& point : points) {
                const float along = glm::dot(axis, point);
                expected = {std::min(expected.low, along), std::max(expected.high, along)};
                farthest = std::max(farthest, glm::distance(point, axis));
            }
            const renderer::Interval found = clusters.extend({1, -1}, axis);
            ASSERT_EQ(found.low, expected.low) << count;
            ASSERT_EQ(found.high, expected.high) << count;
            ASSERT_EQ(clusters.farthest(0.5f, axis), farthest) << count;
        }
    }
}

} // namespace
} // namespace nacre::tests
