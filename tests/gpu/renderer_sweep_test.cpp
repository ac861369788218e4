// A material looks the same at every distance, resolution, field of view and projection: light across a shadow's edge,
// per millimetre of surface, from cameras that have nothing else in common.
#include "tests/gpu/support/renderer_scenes.hpp"

#include <functional>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class Sweep : public RendererTest {};

constexpr float lit = 1; ///< irradiance outside the shadow

/// A plane with a shadow's edge along x = 0, lit where x > 0; what throws the shadow is out of every camera's way.
scene::Scene shadowEdge() {
    scene::Scene scene = darkScene(0.06f);
    Material material{.name = "layered", .description = {}};
    material.layers = {{{0.5, 0.3, 0.2}, 2}, {{0.3, 0.5, 0.2}, 6}, {{0.2, 0.2, 0.6}, 20}};
    material.translucency = 0;
    scene.materials.push_back(material);
    add(scene, square(0.24f)).material = 0;
    add(scene, square(0.2f), glm::translate(glm::mat4(1), {-0.18f, 0, 0.08f})).doubleSided = true;
    scene.lights.push_back(directional({1, 0, -1}, lit * std::sqrt(2.0f)));
    return scene;
}

/// x in mm of a pixel's centre on the plane z = 0.
float millimeters(const scene::Camera& camera, const Pixels& pixels, std::uint32_t column) {
    const bool perspective = camera.projection == scene::ProjectionKind::Perspective;
    const float half =
        perspective ? std::tan(camera.verticalFieldOfView / 2) * camera.position.z : camera.orthographicHeight / 2;
    const float ndc = 2 * (static_cast<float>(column) + 0.5f) / static_cast<float>(pixels.width) - 1;
    return 1000 * (ndc - camera.offCenter.x) * half * static_cast<float>(pixels.width) /
           static_cast<float>(pixels.height);
}

/// Scattered light of the picture's middle row at x = -12, -11, … 12 mm, three channels each.
std::vector<float> profile(const scene::Scene& scene, const renderer::RenderSettings& settings) {
    const Pixels pixels = render(scene, settings).read(Output::Scattered);
    const scene::Camera& camera = scene.cameras[0];
    std::vector<float> result;
    for (float x = -12; x <= 12; ++x) {
        std::uint32_t column = 0;
        while (millimeters(camera, pixels, column + 1) < x) {
            ++column;
        }
        const float before = millimeters(camera, pixels, column);
        const float t = (x - before) / (millimeters(camera, pixels, column + 1) - before);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            result.push_back(std::lerp(at(pixels, column, pixels.height / 2, channel),
                                       at(pixels, column + 1, pixels.height / 2, channel), t));
        }
    }
    return result;
}

struct Variant {
    const char* name;
    std::function<void(scene::Camera&, renderer::RenderSettings&)> apply;
};

void expectSameLight(NacreTechnique technique) {
    using scene::Camera;
    using Settings = renderer::RenderSettings;
    const std::vector<Variant> variants{
        {"half the distance", [](Camera& camera, Settings&) { camera.position.z *= 0.5f; }},
        {"twice the resolution", [](Camera&, Settings& settings) { settings.width *= 2, settings.height *= 2; }},
        {"half the field of view", [](Camera& camera, Settings&) { camera.verticalFieldOfView *= 0.5f; }},
        {"orthographic",
         [](Camera& camera, Settings&) {
             camera.projection = scene::ProjectionKind::Orthographic;
             camera.orthographicHeight = 0.03f;
         }},
        {"off-centre",
         [](Camera& camera, Settings&) {
             camera.offCenter = {0.3f, -0.25f};
         }},
        {"other planes", [](Camera& camera, Settings&) { camera.nearPlane = 0.001f, camera.farPlane = 100; }}};
    renderer::RenderSettings settings = plainSettings();
    settings.shadowMapSize = 2048;
    settings.scatter = true;
    settings.technique = technique;
    const scene::Scene scene = shadowEdge();
    const std::vector<float> reference = profile(scene, settings);
    EXPECT_LT(reference[0], 0.1f * lit);
    EXPECT_GT(reference.back(), 0.9f * lit);
    for (const Variant& variant : variants) {
        scene::Scene changed = scene;
        renderer::RenderSettings changedSettings = settings;
        variant.apply(changed.cameras[0], changedSettings);
        const std::vector<float> light = profile(changed, changedSettings);
        for (std::size_t i = 0; i < light.size(); ++i) {
            EXPECT_NEAR(light[i], reference[i], 0.02f * lit)
                << variant.name << ", x = " << static_cast<int>(i / 3) - 12;
        }
    }
}

TEST_F(Sweep, Default) {
    expectSameLight(NACRE_TECHNIQUE_DEFAULT);
}

TEST_F(Sweep, Separable) {
    expectSameLight(NACRE_TECHNIQUE_SEPARABLE);
}

} // namespace
} // namespace nacre::tests
