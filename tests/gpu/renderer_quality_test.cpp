// The techniques against `brute` on what people look at: the gallery, its bodies from near by, and a scanned head
// and the Stanford dragon where they are. PSNR over the subsurface pixels of the scattered light; the peak is the
// reference's largest value.
#include "tests/gpu/support/renderer_scenes.hpp"

#include "image/metrics.hpp"
#include "nacre/presets.hpp"
#include "scene/gallery/gallery.hpp"
#include "scene/import.hpp"
#include "scene/surface_material.hpp"

#include <algorithm>
#include <filesystem>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class Quality : public RendererTest {};

double qualityOf(const Pixels& image, const Pixels& reference, const Pixels& material) {
    Mask mask(material.values.size());
    std::ranges::transform(material.values, mask.begin(), [](float id) { return static_cast<std::uint8_t>(id != 0); });
    EXPECT_GT(countedPixels(reference, mask), 1000u) << "too few subsurface pixels to say anything";
    return errors(image, reference, mask).psnr(quantile(reference, 1, mask));
}

struct Target {
    NacreTechnique technique;
    const char* name;
};
constexpr Target targets[] = {{NACRE_TECHNIQUE_SEPARABLE, "separable"},
                              {NACRE_TECHNIQUE_BANK, "bank"},
                              {NACRE_TECHNIQUE_BANK_SURFACES, "bank-surfaces"}};

// What the techniques are to have, dB.
constexpr double leastOfSeparable = 38;

/// One scene under all techniques: making its pipelines takes a software device longer than drawing does.
class Comparison {
public:
    explicit Comparison(const scene::Scene& scene) : renderer_(device(), scene, settings()) {}

    renderer::Offscreen& renderer() { return renderer_; }

    void expectQuality(const scene::Camera& camera, const std::string& name, double leastOfBank = 45) {
        renderer::EffectSettings effect = settings();
        renderer_.setEffect(effect);
        renderer_.render(camera);
        const Pixels reference = renderer_.read(Output::Scattered);
        const Pixels material = renderer_.read(Output::Material);
        for (const Target& target : targets) {
            effect.technique = target.technique;
            renderer_.setEffect(effect);
            renderer_.renderEffect();
            const double quality = qualityOf(renderer_.read(Output::Scattered), reference, material);
            std::printf("%s, %s: %.1f dB\n", name.c_str(), target.name, quality);
            EXPECT_GE(quality, target.technique == NACRE_TECHNIQUE_BANK            ? leastOfBank
                               : target.technique == NACRE_TECHNIQUE_BANK_SURFACES ? 45
                                                                                   : leastOfSeparable)
                << name << ", " << target.name;
        }
    }

private:
    static renderer::RenderSettings settings() {
        renderer::RenderSettings settings;
        settings.width = 256;
        settings.height = 144;
        settings.shadowMapSize = 512;
        settings.transmit = false;
        settings.technique = NACRE_TECHNIQUE_BRUTE;
        return settings;
    }

    renderer::Offscreen renderer_;
};

const std::filesystem::path models = std::filesystem::path(NACRE_SOURCE_DIR) / "../shared/models";

scene::Bounds boundsOf(const scene::Scene& scene, const std::string& name) {
    scene::Bounds bounds;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Vertex& vertex : scene.meshes.at(instance.mesh).vertices) {
            const glm::vec3 position(instance.transform * glm::vec4(vertex.position, 1));
            bounds.low = instance.name == name ? glm::min(bounds.low, position) : bounds.low;
            bounds.high = instance.name == name ? glm::max(bounds.high, position) : bounds.high;
        }
    }
    return bounds;
}

/// Looks at the middle of the bounds from this direction, from so many of their radii away.
scene::Camera lookAt(const scene::Bounds& bounds, const glm::vec3& from, float radii) {
    scene::Camera camera;
    camera.target = bounds.center();
    camera.position = bounds.center() + radii * bounds.radius() * glm::normalize(from);
    camera.verticalFieldOfView = 0.5f;
    return camera;
}

TEST_F(Quality, GalleryAndItsBodies) {
    scene::Scene scene = scene::makeGallery(scene::GalleryLight::Front);
    Comparison front(scene);
    front.expectQuality(scene.cameras.at(0), "gallery");
    front.expectQuality(lookAt(boundsOf(scene, "head"), {0, 0, 1}, 4), "gallery's head");
    front.expectQuality(lookAt(boundsOf(scene, "dragon"), {0, 0.1f, 1}, 2.5f), "gallery's dragon");
    front.expectQuality(lookAt(boundsOf(scene, "logo"), {0, 0.3f, 1}, 2.5f), "gallery's logo");
    front.expectQuality(lookAt(boundsOf(scene, "shell"), {0, 0.2f, 1}, 2.5f), "gallery's shell");
    front.expectQuality(lookAt(boundsOf(scene, "plant"), {0, 0.2f, 1}, 2.5f), "gallery's plant");
    scene.lights = scene::galleryLights(scene::GalleryLight::Back);
    Comparison(scene).expectQuality(scene.cameras.at(0), "gallery from behind");
}

TEST_F(Quality, ScannedHead) {
    const std::filesystem::path file = models / "head/infinite_head.gltf";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << file << " is not here";
    }
    scene::Scene scene = scene::load(file);
    scene::assignMaterial(scene, *findPreset("skin"));
    Comparison head(scene);
    head.expectQuality(scene.cameras.at(0), "scanned head");
    head.expectQuality(lookAt(scene::bounds(scene), {1, 0.1f, 0.2f}, 3), "scanned head's side");
}

TEST_F(Quality, Dragon) {
    const std::filesystem::path file = models / "dragon/dragon_uv.glb";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << file << " is not here";
    }
    scene::Scene scene = scene::load(file);
    const scene::Bounds bounds = scene::bounds(scene);
    const scene::Camera front = lookAt(bounds, {-1, 0.1f, 0.15f}, 3);
    scene::assignMaterial(scene, *findPreset("skin"));
    Comparison dragon(scene);
    for (const char* preset : {"skin", "marble", "jade"}) {
        dragon.renderer().setMaterials({*findPreset(preset)});
        const std::string name = std::string(preset) + " dragon";
        dragon.expectQuality(scene.cameras.at(0), name);
        dragon.expectQuality(lookAt(bounds, {0, 0.1f, 1}, 2.2f), name + "'s side");
        dragon.expectQuality(front, name + "'s front");
    }
    // Seen from the front, features lie one behind the other that are as small as jade's light goes far: what its
    // preset asks for second surfaces for.
    Material jade = *findPreset("jade");
    jade.secondSurfaces = false;
    dragon.renderer().setMaterials({jade});
    dragon.expectQuality(front, "jade dragon's front, not asking for second surfaces", 43);
}

} // namespace
} // namespace nacre::tests
