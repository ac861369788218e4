// Rays, lights and random numbers of trace/: what the references stand on.
#include "tests/support/mean.hpp"
#include "tests/support/reference_scenes.hpp"
#include "trace/area.hpp"
#include "trace/illumination.hpp"
#include "trace/punctual.hpp"
#include "trace/view.hpp"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <numbers>

namespace {

using namespace nacre;
using namespace nacre::test;

constexpr double pi = std::numbers::pi;

trace::SurfacePoint below(const trace::Geometry& geometry, const glm::vec3& from) {
    trace::Ray ray;
    ray.origin = from;
    ray.direction = {0, -1, 0};
    const auto hit = geometry.visible(ray);
    EXPECT_TRUE(hit.has_value());
    return geometry.surfaceAt(hit.value_or(trace::Hit{}));
}

TEST(RandomTest, IsPhilox) {
    // The known answers that its authors publish with their code (Random123, kat_vectors).
    EXPECT_EQ(trace::philox({0, 0, 0, 0}, {0, 0}),
              (std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(trace::philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
              (std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
}

TEST(RandomTest, SamplesAreTheirOwn) {
    trace::Random one(1, 2, 3);
    trace::Random again(1, 2, 3);
    trace::Random other(1, 2, 4);
    double sum = 0;
    for (int i = 0; i < 4000; ++i) {
        const double value = one.uniform();
        EXPECT_EQ(value, again.uniform());
        EXPECT_NE(value, other.uniform());
        sum += value;
    }
    EXPECT_NEAR(sum / 4000, 0.5, 0.02);
}

TEST(GeometryTest, BackFacesAreInvisibleUnlessDoubleSided) {
    scene::Scene scene = darkScene();
    addMesh(scene, rectangle({-1, -1}, {1, 1}, 0), addSurface(scene, nullptr));
    const auto seenFromBelow = [&] {
        const trace::Geometry geometry(scene);
        trace::Ray ray;
        ray.origin = {0.3f, -5, 0.2f};
        ray.direction = {0, 1, 0};
        EXPECT_TRUE(geometry.occluded(ray));
        return geometry.visible(ray).has_value();
    };
    EXPECT_FALSE(seenFromBelow());
    scene.surfaces[0].doubleSided = true;
    EXPECT_TRUE(seenFromBelow());
}

TEST(GeometryTest, MirroredInstancesFaceOutwards) {
    scene::Scene scene = darkScene();
    addMesh(scene, ball(2), addSurface(scene, nullptr), glm::scale(glm::mat4(1), glm::vec3(-1, 2, 1)));
    const trace::Geometry geometry(scene);
    const trace::SurfacePoint top = below(geometry, {0.1f, 10, 0.1f});
    EXPECT_NEAR(top.position.y, 4, 0.02);
    EXPECT_GT(top.normal.y, 0.97f);
    EXPECT_GT(top.vertexNormal.y, 0.99f);
    EXPECT_EQ(geometry.openEdges(trace::allInstances), 0u);
}

TEST(GeometryTest, MaskedTexelsAreHoles) {
    scene::Scene scene = darkScene();
    const std::uint32_t surface = addSurface(scene, nullptr);
    scene::Texture texture{.name = "half",
                           .width = 2,
                           .height = 1,
                           .wrapU = scene::Wrap::Clamp,
                           .wrapV = scene::Wrap::Clamp,
                           .pixels = {}};
    texture.pixels = {255, 255, 255, 0, 255, 255, 255, 255};
    scene.textures.push_back(texture);
    scene.surfaces[surface].baseColorTexture = 0;
    scene.surfaces[surface].alphaMode = scene::AlphaMode::Mask;
    scene::Mesh mesh = rectangle({-1, -1}, {1, 1}, 0);
    for (scene::Vertex& vertex : mesh.vertices) {
        vertex.uv = {0.5f + 0.5f * vertex.position.x, 0.5f};
    }
    addMesh(scene, mesh, surface);
    const trace::Geometry geometry(scene);
    trace::Ray ray;
    ray.direction = {0, -1, 0};
    ray.origin = {-0.6f, 1, 0.1f};
    EXPECT_FALSE(geometry.occluded(ray));
    EXPECT_FALSE(geometry.closest(ray).has_value());
    ray.origin.x = 0.6f;
    EXPECT_TRUE(geometry.occluded(ray));
    EXPECT_EQ(geometry.openEdges(trace::allInstances), 4u);
}

TEST(AreaSamplerTest, CoversTheSurfaceEvenly) {
    scene::Scene scene = darkScene();
    addMesh(scene, box({0, 0, 0}, {1, 2, 3}), addSurface(scene, nullptr));
    const trace::Geometry geometry(scene);
    const std::array<std::uint32_t, 1> all{0};
    const trace::AreaSampler sampler(geometry, all);
    EXPECT_NEAR(sampler.area(), 22, 1e-5);
    Mean mean;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        trace::Random random(1, 0, i);
        mean.add(geometry.placeOf(sampler.sample(random)).position);
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(mean.value()[axis], 0.5 * (axis + 1), 4 * mean.standardError()[axis]);
    }
}

TEST(PunctualTest, FallsWithTheSquareWithinRangeAndCone) {
    scene::Light light = directionalLight({0, -2, 0});
    light.kind = scene::LightKind::Spot;
    light.direction = {0, -1, 0};
    light.intensity = 3;
    light.innerConeAngle = 0.2f;
    light.outerConeAngle = 0.4f;
    EXPECT_NEAR(trace::arrivingLight(light, {0, -2000, 0}, 0.001).irradiance.g, 3.0 / 4, 1e-9);
    light.range = 4;
    EXPECT_NEAR(trace::arrivingLight(light, {0, -2000, 0}, 0.001).irradiance.g, 3.0 / 4 * (1 - 1.0 / 16), 1e-9);
    EXPECT_EQ(trace::arrivingLight(light, {0, -5000, 0}, 0.001).irradiance.g, 0);
    const double angle = 0.3;
    const double cone = (std::cos(angle) - std::cos(0.4f)) / (std::cos(0.2f) - std::cos(0.4f));
    light.range = 0;
    EXPECT_NEAR(trace::arrivingLight(light, {1000 * std::sin(angle), -1000 * std::cos(angle), 0}, 0.001).irradiance.g,
                3 * cone * cone, 1e-6);
}

TEST(IlluminationTest, ShadowsAndCosine) {
    scene::Scene scene = darkScene();
    const std::uint32_t grey = addSurface(scene, nullptr);
    addMesh(scene, rectangle({-50, -50}, {50, 50}, 0), grey);
    addMesh(scene, rectangle({-50, -50}, {0, 50}, 10), grey);
    scene.lights = {directionalLight({-1, -1, 0})};
    scene.lights[0].intensity = 2;
    const trace::Geometry geometry(scene);
    const trace::Illumination illumination(geometry);
    EXPECT_NEAR(illumination.direct(below(geometry, {-9, 5, 0})).r, 2 * std::sqrt(0.5), 1e-6);
    EXPECT_EQ(illumination.direct(below(geometry, {-11, 5, 0})).r, 0);
    EXPECT_EQ(illumination.direct(below(geometry, {-9, 5, 0}), trace::Side::Back).r, 0);
}

class SurroundingsTest : public testing::TestWithParam<bool> {};

TEST_P(SurroundingsTest, IrradianceOfAnImageIsItsIntegral) {
    scene::Scene scene = darkScene();
    addMesh(scene, rectangle({-50, -50}, {50, 50}, 0), addSurface(scene, nullptr));
    // A gradient with, or without, a small bright spot, which decides how it is sampled; turned about the vertical.
    nacre::Image image{64, 32, {"R", "G", "B", "A"}, {}};
    for (std::uint32_t i = 0; i < 64 * 32; ++i) {
        const bool spot = GetParam() && i % 64 == 40 && i / 64 == 6;
        image.values.insert(image.values.end(), {spot ? 500.0f : 1.0f, i / 64 < 16 ? 2.0f : 0.0f, 1, 1});
    }
    scene.environment.image = image;
    scene.environment.rotation = 0.7f;
    const trace::Geometry geometry(scene);
    const trace::Illumination illumination(geometry);
    const trace::Surroundings surroundings(scene.environment);
    glm::dvec3 expected(0);
    constexpr int steps = 800;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < 2 * steps; ++j) {
            const double theta = 0.5 * pi * (i + 0.5) / steps;
            const double phi = pi * (j + 0.5) / steps;
            const glm::dvec3 direction(std::sin(theta) * std::cos(phi), std::cos(theta),
                                       std::sin(theta) * std::sin(phi));
            expected += surroundings.radiance(direction) * (std::cos(theta) * std::sin(theta));
        }
    }
    expected *= 0.5 * pi / steps * pi / steps;
    const trace::SurfacePoint point = below(geometry, {1, 5, 2});
    Mean mean;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        trace::Random random(1, 0, i);
        mean.add(illumination.ambient(point, trace::Side::Front, random));
    }
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(mean.value()[channel], expected[channel], 4 * mean.standardError()[channel] + 1e-3);
    }
    EXPECT_LT(mean.standardError().r / mean.value().r, 0.015);
}

INSTANTIATE_TEST_SUITE_P(Spot, SurroundingsTest, testing::Bool());

TEST(ViewTest, RaysGoThroughTheirPixels) {
    scene::Camera camera;
    camera.position = {1, 2, 3};
    camera.target = {0, 0.5f, -1};
    camera.offCenter = {0.2f, -0.1f};
    for (const auto kind : {scene::ProjectionKind::Perspective, scene::ProjectionKind::Orthographic}) {
        camera.projection = kind;
        const trace::View view(camera, 300, 200);
        for (const glm::dvec2 place : {glm::dvec2(0.5, 0.5), glm::dvec2(299.5, 10.25), glm::dvec2(150, 199)}) {
            const trace::Ray ray = view.ray(place.x, place.y);
            const auto back = view.project(glm::dvec3(ray.origin) + 4.0 * glm::dvec3(ray.direction));
            ASSERT_TRUE(back.has_value());
            EXPECT_NEAR(back->x, place.x, 1e-3);
            EXPECT_NEAR(back->y, place.y, 1e-3);
        }
    }
}

} // namespace
