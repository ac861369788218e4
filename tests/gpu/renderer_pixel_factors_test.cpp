// Textures of a material's lengths and of the light that comes through count in every pixel: a body whose texture has
// two halves is, in each of them, the body without a texture whose material has that half's values.
#include "tests/gpu/support/renderer_scenes.hpp"

#include "nacre/presets.hpp"
#include "reference/reference.hpp"

#include <array>
#include <string>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class PixelFactors : public RendererTest {};

constexpr std::uint32_t side = 100; // px
constexpr std::uint32_t border = 2; // px, of a nearest texture
constexpr double leftShare = 51.0 / 255;
constexpr float largestScale = 2;
constexpr double leftScale = largestScale * 64.0 / 255;
using Texel = std::array<std::uint8_t, 4>;

renderer::RenderSettings halvesSettings() {
    renderer::RenderSettings settings = plainSettings();
    settings.width = settings.height = side;
    settings.shadowMapSize = 512;
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

/// A thin wall under two lamps and even surroundings.
scene::Scene wallScene() {
    Material material = *findPreset("leaf");
    material.diffuseTransmission = 0.8;
    material.diffuseTransmissionColor = Rgb{0.1, 0.9, 0.5};
    scene::Scene scene = pictureOf(square(0.0202f), material);
    scene.surfaces[0].doubleSided = true;
    scene.surfaces[0].thickness = 0.001f;
    scene.lights = {directional({0, 0, 1}, 3), directional({0, 0, -1}, 1)};
    scene.environment.intensity = 0.3f;
    scene.environment.zenith = scene.environment.horizon = scene.environment.ground = glm::vec3(1);
    return scene;
}

/// A slab under a lamp behind, a shadow edge of one in front, and surroundings that are brighter behind.
scene::Scene slabScene() {
    scene::Scene scene = pictureOf(box({0.0202f, 0.0202f, 0.001f}), *findPreset("skin"));
    scene.materials[0].secondSurfaces = false; // which would have pipelines of its own to compile
    scene.surfaces[0].thickness = 1;
    scene.lights = {directional({0, 0, 1}, 3), directional(glm::normalize(glm::vec3(0, -1, -1)), 3)};
    add(scene, square(0.2f), glm::translate(glm::mat4(1), glm::vec3(0, 0.15f, 0.05f))).doubleSided = true;
    scene.environment.intensity = 1;
    nacre::Image image{8, 4, {"R", "G", "B", "A"}, std::vector<float>(8 * 4 * 4, 0.1f)};
    for (std::size_t row = 0; row < 4; ++row) {
        std::fill_n(&image.values[4 * (8 * row + 2)], 4 * 4, 2.0f); // -Z is in the middle
    }
    scene.environment.image = std::move(image);
    return scene;
}

/// Gives the first surface a texture of two texels.
void setHalves(scene::Scene& scene, std::uint32_t scene::Surface::*slot, const Texel& left, const Texel& right,
               bool srgb = false) {
    scene::Texture texture{.name = "halves", .width = 2, .height = 1, .srgb = srgb, .nearest = true};
    texture.pixels.insert(texture.pixels.end(), left.begin(), left.end());
    texture.pixels.insert(texture.pixels.end(), right.begin(), right.end());
    scene.surfaces[0].*slot = static_cast<std::uint32_t>(scene.textures.size());
    scene.textures.push_back(std::move(texture));
}

scene::Scene texturedWall() {
    scene::Scene scene = wallScene();
    setHalves(scene, &scene::Surface::transmissionTexture, {0, 0, 0, 51}, {0, 0, 0, 255});
    setHalves(scene, &scene::Surface::transmissionColorTexture, {255, 188, 0, 255}, {0, 188, 255, 255}, true);
    return scene;
}

Pixels radianceOf(renderer::Offscreen& renderer, const scene::Scene& scene, const Material& material) {
    renderer.setMaterials({material});
    renderer.render(scene.cameras[0]);
    return renderer.read(Output::Radiance);
}

/// Expects the textured scene's picture to be made of two of the plain one's.
void expectHalves(const Pixels& textured, const Pixels& left, const Pixels& right, const std::string& what) {
    double seen = 0;
    double difference = 0;
    for (std::size_t i = 0; i < textured.values.size(); ++i) {
        const std::size_t x = i / 3 % side;
        if (x + border >= side / 2 && x < side / 2 + border) {
            continue;
        }
        const float expected = x < side / 2 ? left.values[i] : right.values[i];
        ASSERT_NEAR(textured.values[i], expected, 2e-3f * (1 + expected))
            << what << ", pixel " << x << ", " << i / 3 / side << ", channel " << i % 3;
        seen += static_cast<double>(expected);
        difference += static_cast<double>(std::abs(left.values[i] - right.values[i]));
    }
    EXPECT_GT(difference, 0.02 * seen) << what << ": the halves are told apart";
}

/// Expects that of diffuse light references have the same, in either half.
void expectReference(const scene::Scene& scene, const renderer::Offscreen& renderer, reference::Method method) {
    const Pixels radiance = renderer.read(Output::Radiance);
    const Pixels specular = renderer.read(Output::Specular);
    reference::Settings settings;
    settings.method = method;
    settings.width = settings.height = side;
    reference::Reference exact(scene, scene.cameras[0], settings);
    exact.run({.spp = 2}, [](const reference::Progress&) { return true; });
    for (const std::uint32_t first : {10u, 60u}) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            double expected = 0;
            double actual = 0;
            for (std::uint32_t y = 10; y < 90; ++y) {
                for (std::uint32_t x = first; x < first + 30; ++x) {
                    expected += exact.film().pixels[y * side + x].mean()[static_cast<int>(channel)];
                    actual += static_cast<double>(at(radiance, x, y, channel) - at(specular, x, y, channel));
                }
            }
            EXPECT_NEAR(actual / expected, 1, 0.01)
                << reference::methodName(method) << ", from " << first << ", channel " << channel;
        }
    }
}

TEST_F(PixelFactors, AThinWallHasItsShareAndItsColourInEveryPixel) {
    const scene::Scene plain = wallScene();
    const scene::Scene textured = texturedWall();
    renderer::Offscreen plainRenderer(device(), plain, halvesSettings());
    renderer::Offscreen texturedRenderer(device(), textured, halvesSettings());
    for (const bool hasOwn : {false, true}) { // else the texture stands in for the albedo
        Material material = plain.materials[0];
        const Rgb own = hasOwn ? *material.diffuseTransmissionColor : Rgb{1, 1, 1};
        if (!hasOwn) {
            material.diffuseTransmissionColor.reset();
        }
        const Pixels picture = radianceOf(texturedRenderer, textured, material);
        const double middle = 0.5029 * own[1]; // sRGB 188
        material.diffuseTransmissionColor = Rgb{0, middle, own[2]};
        const Pixels right = radianceOf(plainRenderer, plain, material);
        material.diffuseTransmissionColor = Rgb{own[0], middle, 0};
        material.diffuseTransmission *= leftShare;
        const Pixels left = radianceOf(plainRenderer, plain, material);
        expectHalves(picture, left, right, hasOwn ? "a colour times the texture's" : "the texture's colour");
    }
    expectReference(textured, texturedRenderer, reference::Method::Surface);
    expectReference(textured, texturedRenderer, reference::Method::Walk);
}

TEST_F(PixelFactors, ABodyHasItsLengthsStrengthAndTranslucencyInEveryPixel) {
    const scene::Scene plain = slabScene();
    scene::Scene textured = plain;
    setHalves(textured, &scene::Surface::scaleTexture, {64, 0, 0, 255}, {255, 0, 0, 255});
    setHalves(textured, &scene::Surface::transmissionTexture, {0, 0, 0, 51}, {0, 0, 0, 255});
    textured.surfaces[0].scale = largestScale;
    textured.surfaces[0].transmissionSetsStrength = true;
    const Pixels picture = render(textured, halvesSettings()).read(Output::Radiance);
    renderer::Offscreen plainRenderer(device(), plain, halvesSettings());
    Material material = plain.materials[0];
    material.scale = static_cast<double>(largestScale);
    const Pixels right = radianceOf(plainRenderer, plain, material);
    material.scale = leftScale;
    material.translucency = material.strength = leftShare;
    expectHalves(picture, radianceOf(plainRenderer, plain, material), right, "a slab");
}

} // namespace
} // namespace nacre::tests
