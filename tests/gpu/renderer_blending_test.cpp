// Surfaces that let through what is behind them: the mix in closed form, its order, and what stays as if they were not
// there.
#include "tests/gpu/support/renderer_scenes.hpp"

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class Blending : public RendererTest {};

/// Half floats hold radiance.
constexpr float tolerance = 1e-3f;

/// A lamp that gives a white surface that faces the camera a radiance of 1.
scene::Scene litScene() {
    scene::Scene scene = darkScene(2);
    scene.lights = {directional({0, 0, -1}, pi)};
    return scene;
}

scene::Surface& addMatte(scene::Scene& scene, const glm::vec4& color, float z, float side) {
    scene::Surface& surface = add(scene, square(side), glm::translate(glm::mat4(1), {0, 0, z}));
    surface.baseColor = color;
    surface.roughness = 1;
    surface.specular = 0;
    return surface;
}

void addCard(scene::Scene& scene, const glm::vec4& color, float z) {
    addMatte(scene, color, z, 0.8f).alphaMode = scene::AlphaMode::Blend;
}

constexpr glm::vec3 wallColor(0.2f, 0.4f, 0.6f);

void addWall(scene::Scene& scene) {
    addMatte(scene, glm::vec4(wallColor, 1), -0.5f, 8);
}

glm::vec3 colorAt(const Pixels& pixels, std::uint32_t x, std::uint32_t y) {
    return {at(pixels, x, y, 0), at(pixels, x, y, 1), at(pixels, x, y, 2)};
}

void expectColor(const glm::vec3& found, const glm::vec3& expected, float error = tolerance) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found[i], expected[i], error) << i;
    }
}

TEST_F(Blending, AHalfRedCardIsTheMeanOfRedAndTheWall) {
    scene::Scene scene = litScene();
    addWall(scene);
    addCard(scene, {1, 0, 0, 0.5f}, 0);
    const Pixels radiance = render(scene, plainSettings()).read(Output::Radiance);
    expectColor(colorAt(radiance, 80, 45), 0.5f * glm::vec3(1, 0, 0) + 0.5f * wallColor);
    expectColor(colorAt(radiance, 5, 45), wallColor);
}

TEST_F(Blending, TwoCardsAreMixedFromBackToFrontInAnyOrderOfDrawing) {
    const glm::vec3 expected = 0.25f * glm::vec3(0, 1, 0) + 0.75f * (0.5f * glm::vec3(1, 0, 0) + 0.5f * wallColor);
    for (const bool nearFirst : {true, false}) {
        scene::Scene scene = litScene();
        addWall(scene);
        for (const bool near : {nearFirst, !nearFirst}) {
            addCard(scene, near ? glm::vec4(0, 1, 0, 0.25f) : glm::vec4(1, 0, 0, 0.5f), near ? 0.2f : 0.0f);
        }
        expectColor(colorAt(render(scene, plainSettings()).read(Output::Radiance), 80, 45), expected);
    }
}

TEST_F(Blending, CardsThatCrossChangeOrderWhereTheyDo) {
    scene::Scene scene = darkScene(2);
    for (const float angle : {0.5f, -0.5f}) {
        scene::Surface& surface = add(scene, square(1.2f), glm::rotate(glm::mat4(1), angle, {0, 1, 0}));
        surface.baseColor = {0, 0, 0, 0.5f};
        surface.specular = 0;
        surface.emission = angle > 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        surface.alphaMode = scene::AlphaMode::Blend;
    }
    const Pixels radiance = render(scene, plainSettings()).read(Output::Radiance);
    expectColor(colorAt(radiance, 60, 45), {0.5f, 0.25f, 0});
    expectColor(colorAt(radiance, 100, 45), {0.25f, 0.5f, 0});
}

/// `count` squares one behind the other in one mesh, whose colours are emission; drawn from the middle outwards.
scene::Scene stack(std::uint32_t count) {
    scene::Scene scene = darkScene(2);
    scene::Mesh mesh{.name = "stack"};
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t place = i % 2 == 0 ? (count - i) / 2 : (count + i) / 2;
        scene::Mesh card = square(0.8f);
        for (const std::uint32_t index : card.indices) {
            mesh.indices.push_back(index + static_cast<std::uint32_t>(mesh.vertices.size()));
        }
        for (scene::Vertex& vertex : card.vertices) {
            vertex.position.z = -0.1f * static_cast<float>(place);
            vertex.color.w = place == 0 ? 65535 : 32768;
            mesh.vertices.push_back(vertex);
        }
    }
    scene::Surface& surface = add(scene, std::move(mesh));
    surface.baseColor = {0, 0, 0, 0.5f};
    surface.specular = 0;
    surface.emission = glm::vec3(1);
    surface.alphaMode = scene::AlphaMode::Blend;
    return scene;
}

TEST_F(Blending, TrianglesOfOneMeshNeedNoOrderAndEightLayersAreDrawn) {
    // Half of the nearest, and a quarter of the others: of what the layers before let through.
    const auto expected = [](std::uint32_t layers) {
        return 1 - 0.5f * std::pow(0.75f, static_cast<float>(layers - 1));
    };
    for (const std::uint32_t count : {1u, 5u, 8u, 12u}) {
        const float seen = at(render(stack(count), plainSettings()).read(Output::Radiance), 80, 45);
        EXPECT_NEAR(seen, expected(std::min(count, 8u)), 2 * tolerance) << count;
    }
}

TEST_F(Blending, OverAScatteringBodyTheLightBelowIsWhatItWas) {
    scene::Scene scene = darkScene(3);
    scene.environment.intensity = 0.2f;
    scene.metersPerUnit = 0.1;
    scene.materials = {Material{.name = "wax", .description = {}, .layers = {{{1, 1, 1}, 40}}}};
    add(scene, sphere(0.5f, 24)).material = 0;
    scene.lights = {directional({0.6f, -0.3f, -1}, 2)};
    renderer::RenderSettings settings = plainSettings();
    settings.scatter = settings.transmit = true;
    const renderer::Offscreen bare = render(scene, settings);
    // A dark card with a glow of its own, over all of the picture.
    scene::Surface& card = add(scene, square(4), glm::translate(glm::mat4(1), {0, 0, 1}));
    card.baseColor = {0, 0, 0, 0.3f};
    card.specular = 0;
    card.emission = {0.5f, 0.25f, 0};
    card.alphaMode = scene::AlphaMode::Blend;
    const renderer::Offscreen covered = render(scene, settings);
    for (const Output output : {Output::Depth, Output::Normal, Output::Albedo, Output::Material, Output::Irradiance,
                                Output::Specular, Output::Scattered, Output::Transmitted}) {
        EXPECT_EQ(bare.read(output).values, covered.read(output).values) << static_cast<int>(output);
    }
    const Pixels below = bare.read(Output::Radiance);
    const Pixels mixed = covered.read(Output::Radiance);
    EXPECT_GT(at(below, 80, 45), 0.1f);
    for (std::uint32_t y = 0; y < below.height; ++y) {
        for (std::uint32_t x = 0; x < below.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float expected = 0.7f * at(below, x, y, c) + 0.3f * scene.surfaces[1].emission[c];
                ASSERT_NEAR(at(mixed, x, y, c), expected, tolerance * std::max(1.0f, expected)) << x << ", " << y;
            }
        }
    }
}

/// The radiance of a smooth card before nothing, under surroundings that are even.
float glossOf(scene::AlphaMode mode, float opacity, std::uint8_t textureAlpha) {
    scene::Scene scene = darkScene(2);
    scene.environment.intensity = 1;
    scene.environment.image = nacre::Image{8, 4, {"R", "G", "B", "A"}, std::vector<float>(8 * 4 * 4, 1)};
    scene::Surface& wall = addMatte(scene, {0, 0, 0, 1}, -0.5f, 8);
    wall.roughness = 1;
    scene::Surface& card = addMatte(scene, {0, 0, 0, opacity}, 0, 1);
    card.roughness = 0.1f;
    card.specular = 1;
    card.baseColorTexture = 0;
    card.alphaMode = mode;
    scene.textures.push_back({.name = "alpha", .width = 1, .height = 1, .pixels = {255, 255, 255, textureAlpha}});
    const renderer::Offscreen renderer = render(scene, plainSettings());
    return at(renderer.read(Output::Radiance), 80, 45) -
           (mode == scene::AlphaMode::Blend
                ? (1 - opacity * static_cast<float>(textureAlpha) / 255) * at(renderer.read(Output::Radiance), 5, 45)
                : 0);
}

TEST_F(Blending, ReflectionsOfClearSurfacesAreWholeAndThoseOfUncoveredPartsAreNone) {
    const float whole = glossOf(scene::AlphaMode::Opaque, 1, 255);
    EXPECT_NEAR(whole, 0.08f, 0.01f);
    EXPECT_NEAR(glossOf(scene::AlphaMode::Blend, 0.05f, 255), whole, tolerance);
    EXPECT_NEAR(glossOf(scene::AlphaMode::Blend, 0, 255), whole, tolerance);
    EXPECT_NEAR(glossOf(scene::AlphaMode::Blend, 0.5f, 51), 0.2f * whole, tolerance);
    EXPECT_NEAR(glossOf(scene::AlphaMode::Blend, 1, 0), 0, tolerance);
}

TEST_F(Blending, MoreThanHalfOpaqueThrowsAShadow) {
    for (const float alpha : {0.5f, 0.6f}) {
        scene::Scene scene = litScene();
        scene.lights = {directional({0.5f, 0, -1}, pi)};
        addWall(scene);
        addCard(scene, {0, 0, 0, alpha}, 0.3f);
        // The card's shadow is 0.4 to the right, beyond its own edge as it is seen.
        const Pixels irradiance = render(scene, plainSettings()).read(Output::Irradiance);
        EXPECT_EQ(at(irradiance, 118, 45) > 0.5f, alpha <= 0.5f) << at(irradiance, 118, 45);
        EXPECT_GT(at(irradiance, 20, 45), 0.5f);
    }
}

TEST_F(Blending, BodiesHideAndBackFacesGo) {
    scene::Scene scene = litScene();
    addWall(scene);
    addCard(scene, {1, 0, 0, 0.5f}, -0.6f); // behind the wall
    expectColor(colorAt(render(scene, plainSettings()).read(Output::Radiance), 80, 45), wallColor);
    scene.instances[1].transform = glm::rotate(glm::mat4(1), pi, {0, 1, 0});
    expectColor(colorAt(render(scene, plainSettings()).read(Output::Radiance), 80, 45), wallColor);
    scene.surfaces[1].doubleSided = true;
    expectColor(colorAt(render(scene, plainSettings()).read(Output::Radiance), 80, 45),
                0.5f * glm::vec3(1, 0, 0) + 0.5f * wallColor);
}

TEST_F(Blending, BeforeNothingTheSurroundingsShowThrough) {
    scene::Scene scene = darkScene(2);
    scene.environment.intensity = 1;
    scene.environment.image = nacre::Image{8, 4, {"R", "G", "B", "A"}, std::vector<float>(8 * 4 * 4, 0.25f)};
    addCard(scene, {1, 0, 0, 0.5f}, 0);
    const Pixels radiance = render(scene, plainSettings()).read(Output::Radiance);
    const float reflected = at(radiance, 80, 45, 1) - 0.125f; // at roughness 1 without specular: little
    EXPECT_LT(std::abs(reflected), 5e-3f);
    expectColor(colorAt(radiance, 80, 45), {0.25f + reflected, 0.125f + reflected, 0.125f + reflected}, 2 * tolerance);
}

} // namespace
} // namespace nacre::tests
