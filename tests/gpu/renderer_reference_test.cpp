// Technique `brute` against the surface integral, which shares no code with it: where the camera sees nearly all points
// at which light enters, both are the same integral.
#include "tests/gpu/support/renderer_scenes.hpp"

#include "image/metrics.hpp"
#include "nacre/presets.hpp"
#include "reference/reference.hpp"
#include "scene/primitive_meshes.hpp"
#include "scene/surface_material.hpp"

#include <string>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class Reference : public RendererTest {};

constexpr std::uint32_t width = 96;
constexpr std::uint32_t height = 54;
constexpr double leastPsnr = 45; // dB
/// [px] So far from the picture's edge nearly all light that arrives entered within the picture.
constexpr std::uint32_t margin = 14;

/// An empty scene of millimetres whose first surface is skin without specular reflection.
scene::Scene skinScene() {
    scene::Scene scene = darkScene(100);
    scene.metersPerUnit = 0.001;
    scene.surfaces.resize(2);
    scene::setSurfaceMaterial(scene, scene.surfaces[0], scene::addMaterial(scene, *findPreset("skin-burley"), "skin"));
    scene.surfaces[0].specular = 0;
    return scene;
}

void place(scene::Scene& scene, scene::Mesh mesh, std::uint32_t surface) {
    mesh.surface = surface;
    scene.instances.push_back({mesh.name, static_cast<std::uint32_t>(scene.meshes.size()), glm::mat4(1)});
    scene.meshes.push_back(std::move(mesh));
}

/// Light at 45 degrees, and a camera that sees 26 mm from top to bottom.
void lightAsideAndLookDown(scene::Scene& scene) {
    scene.lights = {directional(glm::normalize(glm::vec3(1, -1, 0)), 3)};
    scene::Camera& camera = scene.cameras[0];
    camera.position = {0, 100, 0};
    camera.up = {0, 0, -1};
    camera.projection = scene::ProjectionKind::Orthographic;
    camera.orthographicHeight = 26;
}

struct Brute {
    Pixels radiance;
    Pixels irradiance;
    Pixels ids;
};

Brute renderBrute(const scene::Scene& scene) {
    renderer::RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.shadowMapSize = 2048;
    settings.technique = NACRE_TECHNIQUE_BRUTE;
    settings.transmit = false;
    const renderer::Offscreen renderer = render(scene, settings);
    return {renderer.read(Output::Radiance), renderer.read(Output::Irradiance), renderer.read(Output::Material)};
}

bool isFarFromEdge(std::size_t pixel) {
    const std::size_t x = pixel % width;
    const std::size_t y = pixel / width;
    return x >= margin && x + margin < width && y >= margin && y + margin < height;
}

/// dB over the pixels in which both see the body. Both have the renderer's light, so that shadow maps are no part of
/// what differs. The reference's noise adds its variance to the mean squared error, and is taken off again.
void expectSameLight(const scene::Scene& scene, std::uint32_t spp, const std::string& what) {
    const Brute brute = renderBrute(scene);
    reference::Settings settings;
    settings.width = width;
    settings.height = height;
    settings.direct = brute.irradiance;
    reference::Reference exact(scene, scene.cameras[0], settings);
    exact.run({.spp = spp}, [](const reference::Progress&) { return true; });
    ErrorSums sums;
    double variance = 0;
    double peak = 0;
    for (std::size_t pixel = 0; pixel < brute.ids.values.size(); ++pixel) {
        const reference::PixelSum& sum = exact.film().pixels[pixel];
        if (!isFarFromEdge(pixel) || brute.ids.values[pixel] == 0 || exact.film().materials[pixel] == 0) {
            continue;
        }
        for (int channel = 0; channel < 3; ++channel) {
            sums.add(static_cast<double>(brute.radiance.values[3 * pixel + static_cast<std::size_t>(channel)]),
                     sum.mean()[channel]);
            variance += sum.variance()[channel];
            peak = std::max(peak, sum.mean()[channel]);
        }
    }
    ASSERT_GT(sums.count(), 3u * 1000);
    variance /= static_cast<double>(sums.count());
    const double noise = psnr(variance, peak);
    const double quality = psnr(std::max(sums.meanSquaredError() - variance, variance / 100), peak);
    std::printf("%s: %.1f dB with the reference's noise, %.1f without; noise %.1f dB, energy %.4f\n", what.c_str(),
                sums.psnr(peak), quality, noise, sums.energyRatio());
    EXPECT_GT(noise, 40) << what << ": too noisy a reference to tell";
    EXPECT_GT(quality, leastPsnr) << what;
    EXPECT_NEAR(sums.energyRatio(), 1, 0.005) << what;
}

TEST_F(Reference, BruteIsTheSurfaceIntegralOnAPlaneWithShadowEdges) {
    scene::Scene scene = skinScene();
    place(scene, scene::rectangle({-60, -45}, {60, 45}, 0), 0);
    // At 45 degrees the shadow of what hangs 30 mm high lies 30 mm further to the right, and its edge in the picture.
    place(scene, scene::rectangle({-90, -60}, {-32, 60}, 30), 1);
    lightAsideAndLookDown(scene);
    expectSameLight(scene, 400, "plane");
}

// The picture shows the middle of a ball of 80 mm: what enters beyond its silhouette is too far from it to matter.
TEST_F(Reference, BruteIsTheSurfaceIntegralOnACurvedSurfaceWithAShadowEdge) {
    scene::Scene scene = skinScene();
    place(scene, scene::ball(40), 0);
    place(scene, scene::rectangle({-120, -60}, {-42, 60}, 80), 1);
    lightAsideAndLookDown(scene);
    expectSameLight(scene, 400, "ball of 80 mm");
}

} // namespace
} // namespace nacre::tests
