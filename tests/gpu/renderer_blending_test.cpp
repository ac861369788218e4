// Surfaces that let through what is behind them: the mix in closed form, its order, and what stays as if they were not
// there.
#include "tests/gpu/support/renderer_scenes.hpp"

#include <array>

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

scene::Surface& addMatte(scene::Scene& scene, const glm::vec4& color, const glm::vec3& place, float side) {
    scene::Surface& surface = add(scene, square(side), glm::translate(glm::mat4(1), place));
    surface.baseColor = color;
    surface.roughness = 1;
    surface.specular = 0;
    return surface;
}

scene::Surface& addCard(scene::Scene& scene, const glm::vec4& color, const glm::vec3& place, float side = 0.2f) {
    scene::Surface& surface = addMatte(scene, color, place, side);
    surface.alphaMode = scene::AlphaMode::Blend;
    return surface;
}

constexpr glm::vec3 red(1, 0, 0);
constexpr glm::vec3 green(0, 1, 0);
constexpr glm::vec3 wall(0.2f, 0.4f, 0.6f);

void addWall(scene::Scene& scene) {
    addMatte(scene, glm::vec4(wall, 1), {0, 0, -0.1f}, 8);
}

/// The colour where the camera sees a point.
glm::vec3 colorAt(const scene::Scene& scene, const Pixels& pixels, const glm::vec3& point) {
    const scene::Camera& camera = scene.cameras[0];
    const float scale = 0.5f * static_cast<float>(pixels.height) /
                        (std::tan(camera.verticalFieldOfView / 2) * (camera.position.z - point.z));
    const auto x = static_cast<std::uint32_t>(0.5f * static_cast<float>(pixels.width) + scale * point.x);
    const auto y = static_cast<std::uint32_t>(0.5f * static_cast<float>(pixels.height) - scale * point.y);
    return {at(pixels, x, y, 0), at(pixels, x, y, 1), at(pixels, x, y, 2)};
}

void expectColor(const glm::vec3& found, const glm::vec3& expected, const std::string& what, float error = tolerance) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found[i], expected[i], error) << what << ", channel " << i;
    }
}

TEST_F(Blending, CardsAreMixedFromBackToFrontInAnyOrderOfDrawing) {
    scene::Scene scene = litScene();
    addWall(scene);
    addCard(scene, {red, 0.5f}, {-0.6f, 0, 0});
    for (const bool nearFirst : {true, false}) {
        const float x = nearFirst ? -0.3f : 0.0f;
        for (const bool near : {nearFirst, !nearFirst}) {
            addCard(scene, near ? glm::vec4(green, 0.25f) : glm::vec4(red, 0.5f), {x, 0, near ? 0.1f : 0.0f});
        }
    }
    addCard(scene, {red, 0.5f}, {0.3f, 0, -0.2f}); // behind the wall
    for (const bool doubleSided : {false, true}) {
        const glm::vec3 place(0.6f, doubleSided ? 0.3f : 0.0f, 0);
        addCard(scene, {red, 0.5f}, place).doubleSided = doubleSided;
        scene.instances.back().transform *= glm::rotate(glm::mat4(1), pi, {0, 1, 0});
    }
    const Pixels radiance = render(scene, plainSettings()).read(Output::Radiance);
    const glm::vec3 one = 0.5f * red + 0.5f * wall;
    expectColor(colorAt(scene, radiance, {-0.6f, 0, 0}), one, "one card");
    expectColor(colorAt(scene, radiance, {-0.3f, 0, 0}), 0.25f * green + 0.75f * one, "the nearer of two drawn first");
    expectColor(colorAt(scene, radiance, {0, 0, 0}), 0.25f * green + 0.75f * one, "the nearer of two drawn last");
    expectColor(colorAt(scene, radiance, {0.3f, 0, 0}), wall, "behind the wall");
    expectColor(colorAt(scene, radiance, {0.6f, 0, 0}), wall, "the back of a card that has one side");
    expectColor(colorAt(scene, radiance, {0.6f, 0.3f, 0}), one, "the back of a card that has two");
    expectColor(colorAt(scene, radiance, {0, 0.3f, 0}), wall, "the wall");
}

TEST_F(Blending, CardsThatCrossChangeOrderWhereTheyDo) {
    scene::Scene scene = darkScene(2);
    for (const float angle : {0.5f, -0.5f}) {
        scene::Surface& card = addCard(scene, {0, 0, 0, 0.5f}, {0, 0, 0}, 1.2f);
        card.emission = angle > 0 ? red : green;
        scene.instances.back().transform = glm::rotate(glm::mat4(1), angle, {0, 1, 0});
    }
    const Pixels radiance = render(scene, plainSettings()).read(Output::Radiance);
    expectColor(colorAt(scene, radiance, {-0.3f, 0, 0}), 0.5f * red + 0.25f * green, "left");
    expectColor(colorAt(scene, radiance, {0.3f, 0, 0}), 0.5f * green + 0.25f * red, "right");
}

/// `count` squares one behind the other in one mesh, in no order of drawing. The nearest has the alpha of its
/// surface, the others half of it.
scene::Mesh stack(std::uint32_t count) {
    scene::Mesh mesh{.name = "stack"};
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t place = (7 * i + 3) % count; // 7 divides none of the counts
        const scene::Mesh card = square(0.2f);
        for (const std::uint32_t index : card.indices) {
            mesh.indices.push_back(index + static_cast<std::uint32_t>(mesh.vertices.size()));
        }
        for (scene::Vertex vertex : card.vertices) {
            vertex.position.z = -0.01f * static_cast<float>(place);
            vertex.color.w = place == 0 ? 65535 : 32768;
            mesh.vertices.push_back(vertex);
        }
    }
    return mesh;
}

TEST_F(Blending, TrianglesOfOneMeshNeedNoOrderAndEightLayersAreDrawn) {
    scene::Scene scene = darkScene(2);
    const std::array counts{1u, 5u, 8u, 12u};
    for (std::size_t i = 0; i < counts.size(); ++i) {
        scene::Mesh mesh = stack(counts[i]);
        scene::Surface& surface =
            add(scene, std::move(mesh), glm::translate(glm::mat4(1), {0.3f * static_cast<float>(i) - 0.45f, 0, 0}));
        surface.baseColor = {0, 0, 0, 0.5f};
        surface.specular = 0;
        surface.emission = glm::vec3(1);
        surface.alphaMode = scene::AlphaMode::Blend;
    }
    const Pixels radiance = render(scene, plainSettings()).read(Output::Radiance);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        // Half of the nearest, and a quarter of the others: of what the layers before let through.
        const float behind = static_cast<float>(std::min(counts[i], 8u) - 1);
        const float expected = 1 - 0.5f * std::pow(0.75f, behind);
        const glm::vec3 place(0.3f * static_cast<float>(i) - 0.45f, 0, 0);
        expectColor(colorAt(scene, radiance, place), glm::vec3(expected), std::to_string(counts[i]) + " cards",
                    2 * tolerance);
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
    settings.technique = NACRE_TECHNIQUE_SEPARABLE; // the quickest to compile
    // A dark card with a glow of its own, over all of the picture; first one that is a hole.
    scene::Surface& card = add(scene, square(4), glm::translate(glm::mat4(1), {0, 0, 1}));
    card.baseColor = {0, 0, 0, 0.3f};
    card.specular = 0;
    card.emission = {0.5f, 0.25f, 0};
    card.alphaMode = scene::AlphaMode::Mask;
    const renderer::Offscreen bare = render(scene, settings);
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

TEST_F(Blending, ReflectionsOfClearSurfacesAreWholeAndThoseOfUncoveredPartsAreNone) {
    scene::Scene scene = darkScene(2);
    scene.environment.intensity = 1;
    scene.environment.image = nacre::Image{8, 4, {"R", "G", "B", "A"}, std::vector<float>(8 * 4 * 4, 1)};
    struct Case {
        glm::vec3 place;
        float opacity;
        std::uint8_t coverage;
        float seen; ///< of the reflection
    };
    // As far from the middle, so that all reflect alike.
    const std::array cases{Case{{0.3f, 0.2f, 0}, 1, 255, 1}, Case{{-0.3f, 0.2f, 0}, 0.05f, 255, 1},
                           Case{{-0.3f, -0.2f, 0}, 0.5f, 51, 0.2f}, Case{{0.3f, -0.2f, 0}, 1, 0, 0}};
    for (const Case& c : cases) {
        scene::Surface& card = addCard(scene, {0, 0, 0, c.opacity}, c.place, 0.3f);
        card.roughness = 0.1f;
        card.specular = 1;
        card.baseColorTexture = static_cast<std::uint32_t>(scene.textures.size());
        scene.textures.push_back({.name = "alpha", .width = 1, .height = 1, .pixels = {255, 255, 255, c.coverage}});
    }
    scene.surfaces[0].alphaMode = scene::AlphaMode::Opaque;
    const Pixels radiance = render(scene, plainSettings()).read(Output::Radiance);
    const float whole = colorAt(scene, radiance, cases[0].place).x;
    EXPECT_NEAR(whole, 0.08f, 0.01f);
    for (const Case& c : cases) {
        // Before the surroundings, whose radiance is 1.
        const float behind =
            c.coverage == 255 && c.opacity == 1 ? 0 : 1 - c.opacity * static_cast<float>(c.coverage) / 255;
        EXPECT_NEAR(colorAt(scene, radiance, c.place).x - behind, c.seen * whole, 2 * tolerance) << c.opacity;
    }
}

TEST_F(Blending, MoreThanHalfOpaqueThrowsAShadow) {
    scene::Scene scene = darkScene(2);
    scene.lights = {directional({0.5f, 0, -1}, pi)};
    addWall(scene);
    addCard(scene, {0, 0, 0, 0.5f}, {0, 0.25f, 0.5f});
    addCard(scene, {0, 0, 0, 0.6f}, {0, -0.25f, 0.5f});
    const Pixels irradiance = render(scene, plainSettings()).read(Output::Irradiance);
    const float lit = colorAt(scene, irradiance, {-0.5f, 0, -0.1f}).x;
    EXPECT_GT(lit, 1);
    // The shadows fall 0.3 to the right.
    EXPECT_NEAR(colorAt(scene, irradiance, {0.3f, 0.25f, -0.1f}).x, lit, 0.01f);
    EXPECT_EQ(colorAt(scene, irradiance, {0.3f, -0.25f, -0.1f}).x, 0);
}

TEST_F(Blending, BeforeNothingTheSurroundingsShowThrough) {
    scene::Scene scene = darkScene(2);
    scene.environment.intensity = 1;
    scene.environment.image = nacre::Image{8, 4, {"R", "G", "B", "A"}, std::vector<float>(8 * 4 * 4, 0.25f)};
    addCard(scene, {red, 0.5f}, {0, 0, 0});
    // The surroundings' diffuse light is right to a hundredth.
    expectColor(colorAt(scene, render(scene, plainSettings()).read(Output::Radiance), {0, 0, 0}),
                0.25f * (0.5f * red + 0.5f), "card", 5e-3f);
}

} // namespace
} // namespace nacre::tests
