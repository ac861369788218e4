// The surface integral against closed forms: within 1 % or three standard errors.
#include "nacre/burley.hpp"
#include "nacre/gaussian.hpp"
#include "nacre/presets.hpp"
#include "reference/surface_integral.hpp"
#include "tests/support/mean.hpp"
#include "tests/support/reference_scenes.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace nacre;
using namespace nacre::test;

/// The mean of ∫ R E dA where a ray downwards from `from` meets the body.
Mean scatteredBelow(const scene::Scene& scene, const glm::vec3& from, int samples, bool exchange = true) {
    trace::Geometry geometry(scene);
    const reference::EntryLight light(geometry);
    const reference::SurfaceIntegral integral(geometry, light, exchange);
    trace::Ray ray;
    ray.origin = from;
    ray.direction = {0, -1, 0};
    const auto hit = geometry.visible(ray);
    EXPECT_TRUE(hit.has_value());
    const trace::SurfacePoint point = geometry.surfaceAt(hit.value_or(trace::Hit{}));
    Mean mean;
    for (int i = 0; i < samples; ++i) {
        trace::Random random(7, 0, static_cast<std::uint32_t>(i));
        mean.add(integral.scattered(point, random));
    }
    return mean;
}

void expectClose(const Mean& mean, const glm::dvec3& expected) {
    for (int channel = 0; channel < 3; ++channel) {
        const double tolerance = std::max(0.01 * expected[channel], 3 * mean.standardError()[channel]);
        EXPECT_NEAR(mean.value()[channel], expected[channel], tolerance) << "channel " << channel;
        // No test that passes for want of samples.
        EXPECT_LT(mean.standardError()[channel], std::max(0.05 * expected[channel], 3e-4)) << "channel " << channel;
    }
}

struct NamedMaterial {
    std::string name;
    Material material;
};

std::vector<NamedMaterial> materials() {
    Material partly = *findPreset("wax");
    partly.layers.push_back({{1, 0.5, 0}, 0}); // some of the light leaves where it entered
    partly.scale = 0.5;
    return {{"Burley", burleyMaterial({0.746, 0.318, 0.175})}, {"Skin", *findPreset("skin")}, {"Partly", partly}};
}

class SurfaceIntegralTest : public testing::TestWithParam<NamedMaterial> {
protected:
    const std::unique_ptr<Profile> profile_ = makeProfile(GetParam().material);

    glm::dvec3 channels(double (Profile::*function)(int, double) const, double argument) const {
        return {(*profile_.*function)(0, argument), (*profile_.*function)(1, argument),
                (*profile_.*function)(2, argument)};
    }
    scene::Scene withBody(scene::Mesh mesh) const {
        scene::Scene scene = darkScene();
        addMesh(scene, std::move(mesh), addSurface(scene, &GetParam().material));
        return scene;
    }
};

TEST_P(SurfaceIntegralTest, ShadowEdgeOnAPlane) {
    scene::Scene scene = withBody(rectangle({-300, -300}, {300, 300}, 0));
    addMesh(scene, rectangle({-300, -300}, {0, 300}, 5), addSurface(scene, nullptr));
    scene.lights = {directionalLight({0, -1, 0})};
    for (const float x : {-2.0f, -0.5f, 0.1f, 1.0f, 4.0f}) {
        SCOPED_TRACE(x);
        expectClose(scatteredBelow(scene, {x, 4, 0}, 12000), channels(&Profile::lineSpreadCumulative, x));
    }
}

TEST_P(SurfaceIntegralTest, CentreOfADiscOfLight) {
    for (const float radius : {0.3f, 1.5f}) {
        scene::Scene scene = withBody(rectangle({-300, -300}, {300, 300}, 0));
        addMesh(scene, ring(radius, 400, 5), addSurface(scene, nullptr));
        scene.lights = {directionalLight({0, -1, 0})};
        SCOPED_TRACE(radius);
        expectClose(scatteredBelow(scene, {0, 4, 0}, 20000), channels(&Profile::cdf, radius));
    }
}

TEST_P(SurfaceIntegralTest, SlabLitFromBehind) {
    for (const float thickness : {0.2f, 1.5f}) {
        scene::Scene scene = withBody(box({-300, -thickness, -300}, {300, 0, 300}));
        scene.lights = {directionalLight({0, 1, 0})};
        SCOPED_TRACE(thickness);
        expectClose(scatteredBelow(scene, {0.1f, 4, 0.2f}, 20000), channels(&Profile::slabTransmittance, thickness));
    }
}

TEST_P(SurfaceIntegralTest, BallLitEvenly) {
    // The area of a sphere within a chord c of a point is πc².
    for (const float radius : {0.5f, 3.0f}) {
        scene::Scene scene = withBody(ball(radius));
        scene.environment = evenSurroundings(1 / std::numbers::pi_v<float>);
        SCOPED_TRACE(radius);
        expectClose(scatteredBelow(scene, {0.1f * radius, 9, 0.2f * radius}, 8000),
                    channels(&Profile::cdf, 2 * radius));
    }
}

INSTANTIATE_TEST_SUITE_P(Materials, SurfaceIntegralTest, testing::ValuesIn(materials()),
                         [](const auto& test) { return test.param.name; });

TEST(SurfaceIntegralExchangeTest, LightCrossesBetweenMaterialsOnlyWhereTheyExchange) {
    const Material one = burleyMaterial({1, 1, 1});
    const Material other = burleyMaterial({0.3, 0.3, 0.3});
    scene::Scene scene = darkScene();
    addMesh(scene, rectangle({-300, -300}, {0, 300}, 0), addSurface(scene, &one));
    addMesh(scene, rectangle({0, -300}, {300, 300}, 0), addSurface(scene, &other));
    scene.lights = {directionalLight({0, -1, 0})};
    const BurleyProfile profile({1, 1, 1});
    expectClose(scatteredBelow(scene, {-0.5f, 4, 0}, 8000, true), glm::dvec3(1));
    expectClose(scatteredBelow(scene, {-0.5f, 4, 0}, 8000, false), glm::dvec3(profile.lineSpreadCumulative(0, 0.5)));
}

TEST(SurfaceIntegralScaleTest, LengthsAreTheSurfacesTimesTheMaterials) {
    const Material material = burleyMaterial({1, 0.5, 0.25});
    scene::Scene scene = darkScene();
    const std::uint32_t surface = addSurface(scene, &material);
    scene.textures.push_back({.name = "half", .width = 1, .height = 1, .pixels = {51, 255, 255, 255}});
    scene.surfaces[surface].scaleTexture = 0;
    scene.surfaces[surface].scale = 10; // times a fifth
    addMesh(scene, rectangle({-300, -300}, {300, 300}, 0), surface);
    addMesh(scene, rectangle({-300, -300}, {0, 300}, 5), addSurface(scene, nullptr));
    scene.lights = {directionalLight({0, -1, 0})};
    const BurleyProfile wide({2, 1, 0.5});
    for (const float x : {-0.5f, 1.0f}) {
        SCOPED_TRACE(x);
        expectClose(
            scatteredBelow(scene, {x, 4, 0}, 12000),
            {wide.lineSpreadCumulative(0, x), wide.lineSpreadCumulative(1, x), wide.lineSpreadCumulative(2, x)});
    }
}

TEST(SurfaceIntegralSheetTest, ADoubleSidedSheetIsLitFromBothSides) {
    const Material material = burleyMaterial({1, 0.5, 0.25});
    scene::Scene scene = darkScene();
    const std::uint32_t surface = addSurface(scene, &material);
    scene.surfaces[surface].doubleSided = true;
    addMesh(scene, rectangle({-300, -300}, {300, 300}, 0), surface);
    scene.lights = {directionalLight({0, -1, 0}), directionalLight({0, 1, 0})};
    scene.lights[1].intensity = 0.25f;
    expectClose(scatteredBelow(scene, {0.2f, 4, 0}, 8000), glm::dvec3(1.25));
}

TEST(SurfaceIntegralSheetTest, AThinWallDividesItsLight) {
    Material material = burleyMaterial({1, 0.5, 0.25});
    material.diffuseTransmission = 0.3;
    material.diffuseTransmissionColor = Rgb{0.5, 1, 0};
    scene::Scene scene = darkScene();
    addMesh(scene, rectangle({-300, -300}, {300, 300}, 0), addSurface(scene, &material));
    scene.lights = {directionalLight({0, -1, 0}), directionalLight({0, 1, 0})};
    scene.lights[1].intensity = 2;
    trace::Geometry geometry(scene);
    const reference::EntryLight light(geometry);
    const reference::SurfaceIntegral integral(geometry, light, true);
    trace::Ray ray;
    ray.origin = {1, 5, 2};
    ray.direction = {0, -1, 0};
    const trace::SurfacePoint point = geometry.surfaceAt(*geometry.visible(ray));
    Mean mean;
    reference::Incidents incidents;
    for (std::uint32_t i = 0; i < 8000; ++i) {
        trace::Random random(7, 0, i);
        mean.add(integral.radiance(point, false, random, incidents) * std::numbers::pi);
    }
    expectClose(mean, glm::dvec3(0.7) + 0.3 * 2.0 * glm::dvec3(0.5, 1, 0));
}

} // namespace
