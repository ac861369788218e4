// Textures of a material's lengths and of the light that comes through count in every pixel: a body whose texture has
// two halves is, in each of them, the body without a texture whose material has that half's values.
#include "tests/gpu/support/renderer_scenes.hpp"

#include "nacre/presets.hpp"
#include "reference/reference.hpp"

#include <array>
#include <functional>
#include <string>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class PixelFactors : public RendererTest {};

constexpr std::uint32_t side = 100; // px
constexpr std::uint32_t border = 2; // px, of a nearest texture
constexpr double leftShare = 51.0 / 255;
using Texel = std::array<std::uint8_t, 4>;

renderer::RenderSettings halvesSettings() {
    renderer::RenderSettings settings = plainSettings();
    settings.width = settings.height = side;
    settings.shadowMapSize = 1000;
    settings.scatter = settings.transmit = true;
    return settings;
}

/// A mesh of 2 cm around the origin that fills the picture from +Z, without specular reflection.
scene::Scene pictureOf(scene::Mesh mesh, const Material& material) {
    scene::Scene scene = darkScene(1);
    scene.cameras[0].projection = scene::ProjectionKind::Orthographic;
    scene.cameras[0].orthographicHeight = 0.02f;
    scene::Surface& surface = add(scene, std::move(mesh));
    surface.material = 0;
    surface.specular = 0;
    surface.baseColor = {0.8f, 0.4f, 0.2f, 1};
    scene.materials.push_back(material);
    return scene;
}

/// A sheet 2 cm wide that is lit from `from`: 1 = the camera's side, -1 = from behind.
scene::Scene leafScene(const Material& material, float from) {
    scene::Scene scene = pictureOf(square(0.0202f), material);
    scene.surfaces[0].doubleSided = true;
    scene.surfaces[0].thickness = 0.001f;
    scene.lights = {directional({0, 0, -from}, pi)};
    return scene;
}

/// Surroundings of which more comes from -Z than from +Z.
void lightBehind(scene::Scene& scene) {
    scene.environment.intensity = 1;
    nacre::Image image{8, 4, {"R", "G", "B", "A"}, std::vector<float>(8 * 4 * 4, 0.1f)};
    for (std::size_t row = 0; row < 4; ++row) {
        for (const std::size_t column : {2u, 3u, 4u, 5u}) { // -Z is in the middle
            std::fill_n(&image.values[4 * (8 * row + column)], 4, 2.0f);
        }
    }
    scene.environment.image = std::move(image);
}

/// The same scene with a texture of two texels.
scene::Scene withHalves(scene::Scene scene, std::uint32_t scene::Surface::*slot, const Texel& left, const Texel& right,
                        bool srgb = false) {
    scene::Texture texture{.name = "halves", .width = 2, .height = 1, .srgb = srgb, .nearest = true};
    texture.pixels.insert(texture.pixels.end(), left.begin(), left.end());
    texture.pixels.insert(texture.pixels.end(), right.begin(), right.end());
    scene.surfaces[0].*slot = static_cast<std::uint32_t>(scene.textures.size());
    scene.textures.push_back(std::move(texture));
    return scene;
}

Pixels radianceOf(const scene::Scene& scene) {
    return render(scene, halvesSettings()).read(Output::Radiance);
}

bool isLeft(std::size_t value) {
    return value / 3 % side < side / 2;
}

bool isAtBorder(std::size_t value) {
    const std::size_t x = value / 3 % side;
    return x + border >= side / 2 && x < side / 2 + border;
}

/// Renders `plain` with the two halves' materials, and expects the textured scene's picture to be made of them.
void expectHalves(const scene::Scene& textured, const scene::Scene& plain,
                  const std::function<void(Material&, bool left)>& change, const std::string& what) {
    const Pixels picture = radianceOf(textured);
    renderer::Offscreen renderer(device(), plain, halvesSettings());
    std::array<Pixels, 2> halves;
    for (const bool left : {true, false}) {
        std::vector<Material> materials = plain.materials;
        change(materials[0], left);
        renderer.setMaterials(materials);
        renderer.render(plain.cameras[0]);
        halves[left ? 0 : 1] = renderer.read(Output::Radiance);
    }
    double seen = 0;
    double difference = 0;
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        if (!isAtBorder(i)) {
            const float expected = halves[isLeft(i) ? 0 : 1].values[i];
            ASSERT_NEAR(picture.values[i], expected, 2e-3f * (1 + expected))
                << what << ", pixel " << i / 3 % side << ", " << i / 3 / side << ", channel " << i % 3;
            seen += static_cast<double>(expected);
            difference += static_cast<double>(std::abs(halves[0].values[i] - halves[1].values[i]));
        }
    }
    EXPECT_GT(difference, 0.02 * seen) << what << ": the halves are told apart";
}

Material wall() {
    Material material = *findPreset("leaf");
    material.diffuseTransmission = 0.8;
    material.diffuseTransmissionColor = Rgb{0.1, 0.9, 0.5};
    return material;
}

TEST_F(PixelFactors, AThinWallHasItsShareInEveryPixel) {
    for (const float from : {1.0f, -1.0f}) {
        scene::Scene plain = leafScene(wall(), from);
        lightBehind(plain);
        const scene::Scene textured =
            withHalves(plain, &scene::Surface::transmissionTexture, {0, 0, 0, 51}, {0, 0, 0, 255});
        expectHalves(
            textured, plain,
            [](Material& material, bool left) { material.diffuseTransmission *= left ? leftShare : 1; },
            "lit from " + std::to_string(from));
    }
}

TEST_F(PixelFactors, AThinWallThatLetsNothingThroughReflectsAll) {
    const scene::Scene scene =
        withHalves(leafScene(wall(), 1), &scene::Surface::transmissionTexture, {0, 0, 0, 0}, {0, 0, 0, 255});
    const Pixels radiance = radianceOf(scene);
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
        const float albedo = scene.surfaces[0].baseColor[static_cast<int>(channel)];
        EXPECT_NEAR(at(radiance, 25, 50, channel), albedo, 0.005f);
        EXPECT_NEAR(at(radiance, 75, 50, channel), 0.2f * albedo, 0.005f);
    }
}

TEST_F(PixelFactors, WhatComesThroughHasTheColourOfThePixel) {
    // sRGB 188 is 0.5029 in linear light.
    const Texel left{255, 188, 0, 255};
    const Texel right{0, 188, 255, 255};
    for (const bool hasOwn : {true, false}) {
        Material material = wall();
        if (!hasOwn) {
            material.diffuseTransmissionColor.reset();
        }
        const glm::vec3 own = hasOwn ? glm::vec3(0.1f, 0.9f, 0.5f) : glm::vec3(1);
        const scene::Scene scene =
            withHalves(leafScene(material, -1), &scene::Surface::transmissionColorTexture, left, right, true);
        const Pixels radiance = radianceOf(scene);
        for (const auto& [x, texel] :
             {std::pair(25u, glm::vec3(1, 0.5029f, 0)), std::pair(75u, glm::vec3(0, 0.5029f, 1))}) {
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(at(radiance, x, 50, static_cast<std::size_t>(channel)),
                            0.8f * own[channel] * texel[channel], 0.005f)
                    << x << ", " << hasOwn;
            }
        }
    }
}

/// A shadow edge along the picture's middle row, of light from the camera's side at 45 degrees.
void castEdge(scene::Scene& scene) {
    scene.lights.push_back(directional(glm::normalize(glm::vec3(0, -1, -1)), 3));
    scene::Surface& plate = add(scene, square(0.2f), glm::translate(glm::mat4(1), glm::vec3(0, 0.15f, 0.05f)));
    plate.doubleSided = true;
}

const std::array scaleTexels{Texel{64, 0, 0, 255}, Texel{255, 0, 0, 255}};
constexpr float largestScale = 2;
constexpr double leftScale = largestScale * 64.0 / 255;

scene::Scene withScales(scene::Scene scene) {
    scene.surfaces[0].scale = largestScale;
    return withHalves(std::move(scene), &scene::Surface::scaleTexture, scaleTexels[0], scaleTexels[1]);
}

void setScale(Material& material, bool left) {
    material.scale = left ? leftScale : static_cast<double>(largestScale);
}

TEST_F(PixelFactors, ScaleMultipliesTheLengthsOfScatteredLight) {
    scene::Scene plain = pictureOf(square(0.1f), *findPreset("skin"));
    castEdge(plain);
    expectHalves(withScales(plain), plain, setScale, "a shadow edge");
}

TEST_F(PixelFactors, ScaleMultipliesTheLengthsOfLightThatComesThrough) {
    scene::Scene plain = pictureOf(box({0.0202f, 0.0202f, 0.001f}), *findPreset("skin"));
    plain.lights = {directional({0, 0, 1}, 3)};
    expectHalves(withScales(plain), plain, setScale, "a slab by its shadow map");
    plain.surfaces[0].thickness = 1;
    plain.lights[0].castsShadow = false;
    lightBehind(plain);
    expectHalves(withScales(plain), plain, setScale, "a slab of authored thickness");
}

TEST_F(PixelFactors, ASurfaceScalesWithoutATexture) {
    scene::Scene scaled = pictureOf(square(0.1f), *findPreset("skin"));
    castEdge(scaled);
    scene::Scene plain = scaled;
    scaled.surfaces[0].scale = 2;
    plain.materials[0].scale = 2;
    const Pixels picture = radianceOf(scaled);
    const Pixels expected = radianceOf(plain);
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        ASSERT_NEAR(picture.values[i], expected.values[i], 2e-3f * (1 + expected.values[i])) << i / 3;
    }
}

TEST_F(PixelFactors, ABodyHasItsTranslucencyInEveryPixel) {
    scene::Scene plain = pictureOf(box({0.0202f, 0.0202f, 0.001f}), *findPreset("skin"));
    plain.surfaces[0].thickness = 1;
    plain.lights = {directional({0, 0, 1}, 3)};
    lightBehind(plain);
    const scene::Scene textured =
        withHalves(plain, &scene::Surface::transmissionTexture, {0, 0, 0, 51}, {0, 0, 0, 255});
    expectHalves(
        textured, plain, [](Material& material, bool left) { material.translucency = left ? leftShare : 1; }, "a slab");
}

TEST_F(PixelFactors, WhatDoesNotEnterDoesNotScatter) {
    scene::Scene plain = pictureOf(square(0.0202f), *findPreset("skin"));
    castEdge(plain);
    scene::Scene textured = withHalves(plain, &scene::Surface::transmissionTexture, {0, 0, 0, 51}, {0, 0, 0, 255});
    textured.surfaces[0].transmissionSetsStrength = true;
    expectHalves(
        textured, plain,
        [](Material& material, bool left) { material.strength = material.translucency = left ? leftShare : 1; },
        "a shadow edge");
}

TEST_F(PixelFactors, ReferencesMeanTheSame) {
    scene::Scene scene =
        withHalves(leafScene(wall(), -1), &scene::Surface::transmissionTexture, {0, 0, 0, 51}, {0, 0, 0, 255});
    scene = withHalves(std::move(scene), &scene::Surface::transmissionColorTexture, {255, 188, 0, 255},
                       {0, 188, 255, 255}, true);
    scene.lights.push_back(directional({0, 0, -1}, 1));
    const Pixels radiance = radianceOf(scene);
    for (const reference::Method method : {reference::Method::Surface, reference::Method::Walk}) {
        reference::Settings settings;
        settings.method = method;
        settings.width = settings.height = side;
        reference::Reference exact(scene, scene.cameras[0], settings);
        exact.run({.spp = method == reference::Method::Surface ? 8 : 1},
                  [](const reference::Progress&) { return true; });
        for (const std::uint32_t first : {10u, 60u}) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                double expected = 0;
                double actual = 0;
                for (std::uint32_t y = 10; y < 90; ++y) {
                    for (std::uint32_t x = first; x < first + 30; ++x) {
                        expected += exact.film().pixels[y * side + x].mean()[static_cast<int>(channel)];
                        actual += static_cast<double>(at(radiance, x, y, channel));
                    }
                }
                EXPECT_NEAR(actual / 2400, expected / 2400, 0.004)
                    << reference::methodName(method) << ", from " << first << ", channel " << channel;
            }
        }
    }
}

} // namespace
} // namespace nacre::tests
