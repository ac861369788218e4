#include "app/render_scene.hpp"
#include "bench/accuracy/accuracy_bodies.hpp"
#include "bench/accuracy/accuracy_view.hpp"
#include "bench/suites/suite_views.hpp"
#include "nacre/presets.hpp"
#include "scene/gallery/gallery.hpp"
#include "scene/primitive_meshes.hpp"
#include "scene/surface_material.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace nacre::bench {
namespace {

using scene::Camera;
using scene::GalleryLight;
using scene::Light;
using scene::Mesh;
using scene::Scene;

constexpr const char* skin = "skin-burley";
// A point light has six shadow maps.
constexpr std::uint32_t shadowMapSizeOfPoints = 2048;

// The way the light travels; the camera is on the side of +z.
const glm::vec3 fromFront{-0.4f, -0.5f, -1};
const glm::vec3 fromSide{-1, -0.2f, 0};
const glm::vec3 fromBehind{0.35f, -0.35f, 1};
// The way from the body to the camera.
const glm::vec3 towardsCamera{0.25f, 0.2f, 1};

AccuracyView finish(Scene scene, const Camera& camera) {
    for (scene::Surface& surface : scene.surfaces) {
        surface.specular = 0;
        surface.emission = glm::vec3(0);
    }
    AccuracyView view;
    const bool hasPoint =
        std::ranges::any_of(scene.lights, [](const Light& light) { return light.kind == scene::LightKind::Point; });
    view.shadowMapSize = hasPoint ? shadowMapSizeOfPoints : view.shadowMapSize;
    view.camera = camera;
    view.scene = std::make_shared<Scene>(std::move(scene));
    return view;
}

// --- Small bodies ---

AccuracyView plane() {
    Scene scene = darkMillimetres();
    addBody(scene, scene::rectangle({-60, -45}, {60, 45}, 0), addPresetSurface(scene, skin));
    const std::uint32_t grey = addGreySurface(scene);
    // The light slants by 45 degrees: what hangs at height h shades what lies h further to the right.
    addBody(scene, scene::rectangle({-90, -60}, {-32, 60}, 30), grey);
    addBody(scene, scene::rectangle({-30, -60}, {-28, 60}, 40), grey);
    scene.lights = {sun({1, -1, 0})};
    return finish(std::move(scene), flatCameraAt({0, 0, 0}, {0, 1, 0}, 27));
}

AccuracyView body(Mesh mesh, const char* preset, const Light& light, float height, const glm::vec3& direction) {
    Scene scene = darkMillimetres();
    addBody(scene, std::move(mesh), addPresetSurface(scene, preset));
    scene.lights = {light};
    return finish(std::move(scene), cameraAt({0, 0, 0}, direction, height));
}

AccuracyView ballView(float radius, const glm::vec3& direction) {
    return body(scene::ball(radius), skin, sun(direction), 2.4f * radius, {0, 0, 1});
}

AccuracyView fin() {
    Scene scene = darkMillimetres();
    const std::uint32_t surface = addPresetSurface(scene, skin);
    addBody(scene, scene::box({-40, -30, -10}, {40, 30, 0}), surface);
    addBody(scene, scene::box({-0.75f, -12, 2}, {0.75f, 12, 16}), surface);
    scene.lights = {sun({0.485f, -0.2f, -0.851f})}; // 61 degrees from the fin's normal
    return finish(std::move(scene), cameraAt({4, 0, 4}, {0.9f, 0.3f, 1}, 32));
}

AccuracyView touching() {
    Scene scene = darkMillimetres();
    addBody(scene, scene::box({-40, -25, -20}, {0, 25, 0}), addPresetSurface(scene, skin));
    addBody(scene, scene::box({0, -25, -20}, {40, 25, 0}), addPresetSurface(scene, "marble"));
    // Slanting by 45 degrees to the left it leaves the right body in the dark, but for 1 mm at the seam.
    const glm::mat4 upright(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, -1, 0, 0),
                            glm::vec4(0, 0, 0, 1));
    addBody(scene, scene::rectangle({41, -60}, {120, 60}, 40), addGreySurface(scene), upright);
    scene.lights = {sun({-1, 0, -1})};
    return finish(std::move(scene), flatCameraAt({0, 0, 0}, {0, 0, 1}, 18));
}

AccuracyView ballUnderSky() {
    Scene scene = darkMillimetres();
    addBody(scene, scene::ball(10), addPresetSurface(scene, skin));
    addBody(scene, scene::rectangle({-80, -80}, {80, 80}, -10), addGreySurface(scene));
    scene.environment = {};
    return finish(std::move(scene), cameraAt({0, 0, 0}, {0, 0.3f, 1}, 24));
}

struct ThinPart {
    const char* name;
    const char* what;
    Mesh (*mesh)();
    const char* preset;
    float height; ///< [mm] of the picture
};

const ThinPart thinParts[] = {
    {"thin-ball", "a ball of 3 mm", [] { return scene::ball(1.5f); }, skin, 3.8f},
    {"slab", "a slab of 1.5 mm",
     [] {
         return scene::box({-10, -6, -0.75f}, {10, 6, 0.75f});
     },
     skin, 15},
    {"wedge", "a wedge, 0.1 to 4 mm thick", [] { return wedge(24, 13, 0.1f, 4); }, skin, 17},
    {"leaf", "a bent leaf of 0.4 mm", [] { return bentSheet(22, 12, 0.4f, 16); }, "leaf", 15},
};

std::vector<AccuracyViewEntry> smallBodies() {
    std::vector<AccuracyViewEntry> views{
        {"plane", "shadow edges on a plane", plane},
        {"ball-20-front", "a ball of 20 mm, lit from the front", [] { return ballView(10, fromFront); }},
        {"ball-20-side", "the same, lit from the side", [] { return ballView(10, fromSide); }},
        {"ball-20-back", "the same, lit from behind", [] { return ballView(10, fromBehind); }},
        {"ball-5-side", "a ball of 5 mm, lit from the side", [] { return ballView(2.5f, fromSide); }},
        {"ball-5-back", "the same, lit from behind", [] { return ballView(2.5f, fromBehind); }}};
    for (const ThinPart& part : thinParts) {
        const auto view = [&part](const glm::vec3& direction) {
            return [&part, direction] {
                return body(part.mesh(), part.preset, sun(direction), part.height, towardsCamera);
            };
        };
        views.push_back(
            {part.name + std::string("-front"), part.what + std::string(", lit from the front"), view(fromFront)});
        views.push_back(
            {part.name + std::string("-back"), part.what + std::string(", lit from behind"), view(fromBehind)});
    }
    const auto wedgeUnder = [](const Light& light) {
        return body(wedge(24, 13, 0.1f, 4), skin, light, 17, towardsCamera);
    };
    views.insert(views.end(),
                 {{"wedge-back-point", "the wedge, a point light behind it",
                   [=] {
                       return wedgeUnder(lamp({-8, 10, -40}));
                   }},
                  {"wedge-back-spot", "the wedge, a spot light behind it",
                   [=] {
                       return wedgeUnder(spotLamp({-8, 10, -40}, 8, 14));
                   }},
                  {"fin", "a fin of 1.5 mm before a wall, lit at 61 degrees to its normal", fin},
                  {"touching", "a block of skin-burley and one of marble that touch, light crossing", touching},
                  {"ball-20-sky", "a ball of 20 mm under a sky alone", ballUnderSky}});
    return views;
}

// --- The gallery ---

/// Made once, in some seconds.
const Scene& wholeGallery() {
    static const Scene gallery = scene::makeGallery();
    return gallery;
}

AccuracyView galleryView(GalleryLight side) {
    Scene scene = wholeGallery();
    scene.lights = scene::galleryLights(side);
    return finish(std::move(scene), wholeGallery().cameras.front());
}

/// One body and what it stands on.
Scene galleryBody(const std::string& name) {
    Scene scene = wholeGallery();
    std::erase_if(scene.instances, [&](const scene::Instance& instance) {
        const bool isBody = scene.surfaces[scene.meshes[instance.mesh].surface].material != scene::none;
        return isBody && instance.name != name;
    });
    return scene;
}

Camera galleryCamera(const Scene& scene, const std::string& name) {
    const auto instance = std::ranges::find(scene.instances, name, &scene::Instance::name);
    return lookAt(boundsOf(scene, *instance), scene.cameras.front());
}

AccuracyView galleryBodyView(const std::string& name, GalleryLight side) {
    Scene scene = galleryBody(name);
    scene.lights = scene::galleryLights(side);
    scene.environment.intensity = 0;
    const Camera camera = galleryCamera(scene, name);
    return finish(std::move(scene), camera);
}

AccuracyView headUnderSky() {
    Scene scene = galleryBody("head");
    scene.lights.clear();
    scene.environment = {};
    const Camera camera = galleryCamera(scene, "head");
    return finish(std::move(scene), camera);
}

std::vector<AccuracyViewEntry> galleryViews() {
    std::vector<AccuracyViewEntry> views{
        {"gallery-front", "the gallery, lit from the front", [] { return galleryView(GalleryLight::Front); }},
        {"gallery-back", "the gallery, lit from behind", [] { return galleryView(GalleryLight::Back); }}};
    for (const char* name : {"head", "dragon", "logo", "shell", "plant"}) {
        const std::string what = std::string("the gallery's ") + name;
        views.push_back({name + std::string("-front"), what + ", lit from the front",
                         [name] { return galleryBodyView(name, GalleryLight::Front); }});
        views.push_back({name + std::string("-back"), what + ", lit from behind",
                         [name] { return galleryBodyView(name, GalleryLight::Back); }});
    }
    views.push_back({"head-sky", "the gallery's head under a sky alone", headUnderSky});
    return views;
}

AccuracyView fileView(const std::filesystem::path& file, const char* side) {
    app::SceneOptions options;
    options.input = file;
    Scene scene = app::makeScene(options);
    if (scene.materials.empty()) {
        scene::assignMaterial(scene, *findPreset(skin));
    }
    options.lights = {side};
    app::chooseLights(options, scene);
    const Camera camera = app::makeCamera(options, scene);
    return finish(std::move(scene), camera);
}

} // namespace

std::vector<AccuracyViewEntry> accuracyViews() {
    std::vector<AccuracyViewEntry> views = smallBodies();
    std::ranges::move(galleryViews(), std::back_inserter(views));
    return views;
}

std::vector<AccuracyViewEntry> accuracyViewsOf(const std::filesystem::path& file) {
    const std::string name = "model-" + file.stem().string(); // no name of the fixed set
    return {
        {name + "-front", file.filename().string() + ", lit from the front",
         [file] { return fileView(file, "front"); }},
        {name + "-back", file.filename().string() + ", lit from behind", [file] { return fileView(file, "back"); }}};
}

} // namespace nacre::bench
