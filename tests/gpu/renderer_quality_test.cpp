// The techniques against `brute` on what people look at: the gallery, its head from near by, and a scanned head where
// there is one. PSNR over the subsurface pixels of the scattered light; the peak is the reference's largest value.
#include "tests/gpu/support/renderer_scenes.hpp"

#include "nacre/presets.hpp"
#include "scene/gallery.hpp"
#include "scene/import.hpp"

#include <filesystem>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;
using renderer::Technique;

class Quality : public RendererTest {};

double psnr(const Pixels& image, const Pixels& reference, const Pixels& material) {
    double peak = 0;
    double error = 0;
    std::size_t count = 0;
    for (std::size_t pixel = 0; pixel < material.values.size(); ++pixel) {
        if (material.values[pixel] == 0) {
            continue;
        }
        for (std::size_t channel = 3 * pixel; channel < 3 * pixel + 3; ++channel) {
            const double difference = double{image.values[channel]} - double{reference.values[channel]};
            peak = std::max(peak, double{reference.values[channel]});
            error += difference * difference;
            ++count;
        }
    }
    EXPECT_GT(count, 3000u) << "too few subsurface pixels to say anything";
    return 10 * std::log10(peak * peak * static_cast<double>(count) / error);
}

/// `separable` is to have 38 dB, and `bank`, the default, no less than 38 dB either.
void expectQuality(const scene::Scene& scene, const scene::Camera& camera, const char* name) {
    renderer::RenderSettings settings;
    settings.width = 320;
    settings.height = 180;
    settings.shadowMapSize = 512;
    settings.transmit = false;
    settings.technique = Technique::Brute;
    renderer::Renderer renderer(device(), scene, settings);
    renderer.render(camera);
    const Pixels reference = renderer.read(Output::Scattered);
    const Pixels material = renderer.read(Output::Material);
    for (const Technique technique : {Technique::Separable, Technique::Bank}) {
        settings.technique = technique;
        renderer.setEffect(settings);
        renderer.renderEffect();
        const double quality = psnr(renderer.read(Output::Scattered), reference, material);
        std::printf("%s, %s: %.1f dB\n", name, technique == Technique::Bank ? "bank" : "separable", quality);
        EXPECT_GE(quality, 38) << name;
    }
}

TEST_F(Quality, GalleryAndItsHead) {
    const scene::Scene scene = scene::makeGallery(scene::GalleryLight::Front);
    expectQuality(scene, scene.cameras.at(0), "gallery");
    for (const scene::Instance& instance : scene.instances) {
        if (instance.name != "head") {
            continue;
        }
        scene::Bounds bounds;
        for (const scene::Vertex& vertex : scene.meshes.at(instance.mesh).vertices) {
            const glm::vec3 position(instance.transform * glm::vec4(vertex.position, 1));
            bounds.low = glm::min(bounds.low, position);
            bounds.high = glm::max(bounds.high, position);
        }
        scene::Camera camera = scene.cameras.at(0);
        camera.target = bounds.center();
        camera.position = bounds.center() + glm::vec3(0, 0, 4 * bounds.radius());
        camera.verticalFieldOfView = 0.5f;
        expectQuality(scene, camera, "gallery's head");
        return;
    }
    FAIL() << "the gallery has no body called head";
}

TEST_F(Quality, ScannedHead) {
    const std::filesystem::path file = std::filesystem::path(NACRE_SOURCE_DIR) / "../shared/models/head/infinite_head.gltf";
    if (!std::filesystem::exists(file)) {
        std::puts("the scanned head is not here");
        return;
    }
    scene::Scene scene = scene::load(file);
    scene::assignMaterial(scene, *findPreset("skin"));
    expectQuality(scene, scene.cameras.at(0), "scanned head");
}

} // namespace
} // namespace nacre::tests
