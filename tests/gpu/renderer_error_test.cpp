// Bad input: one sentence that names the value, and a renderer that still works afterwards.
#include "tests/gpu/support/renderer_scenes.hpp"

#include <functional>
#include <limits>

namespace nacre::tests {
namespace {

class Errors : public RendererTest {};

scene::Scene plane() {
    scene::Scene scene = darkScene(2);
    add(scene, square(3));
    scene.lights.push_back(directional({0, 0, -1}));
    return scene;
}

/// `act` throws RendererError, whose sentence has every one of `words` in it.
void expectRefused(const std::function<void()>& act, const std::vector<std::string>& words) {
    try {
        act();
        FAIL() << "nothing was refused";
    } catch (const renderer::RendererError& error) {
        for (const std::string& word : words) {
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " in: " << error.what();
        }
    }
}

void expectRefused(const scene::Scene& scene, const renderer::RenderSettings& settings,
                   const std::vector<std::string>& words) {
    expectRefused([&] { render(scene, settings); }, words);
}

TEST_F(Errors, SizesBeyondReason) {
    renderer::RenderSettings settings = plainSettings();
    settings.width = settings.height = 0;
    expectRefused(plane(), settings, {"0x0"});
    settings.width = settings.height = 100000;
    expectRefused(plane(), settings, {"100000x100000", "limit"});
    // Within the device's limits, beyond its memory.
    settings = plainSettings();
    settings.shadowMapSize = 16384;
    scene::Scene scene = plane();
    scene.lights.assign(400, point({0, 0, 1}));
    expectRefused(scene, settings, {"shadow maps", "16384x16384"});
    settings = plainSettings();
    settings.samples = 9;
    expectRefused(plane(), settings, {"samples", "9"});
}

TEST_F(Errors, MemoryIsGivenBackAfterARefusal) {
    renderer::RenderSettings settings = plainSettings();
    settings.shadowMapSize = 8192;
    scene::Scene scene = plane();
    scene.lights.assign(300, point({0, 0, 1}));
    expectRefused(scene, settings, {"memory", "shadow maps", "MiB"});
    EXPECT_NO_THROW(render(plane(), plainSettings()));
}

TEST_F(Errors, ShadersThatArePartOfTheProgramAreNotReloaded) {
    const scene::Scene scene = plane();
    renderer::Offscreen renderer = render(scene, plainSettings());
    expectRefused([&] { renderer.reloadShaders(); }, {"shaders are part of this program", "preset developer"});
    EXPECT_NO_THROW(renderer.render(scene.cameras[0]));
}

TEST_F(Errors, TechniquesTooLargeForTheDeviceKeepNoOtherFromThePicture) {
    // What brute keeps of these pixels is more than the 128 MiB of one buffer that Vulkan promises.
    renderer::RenderSettings settings = plainSettings();
    settings.width = 2000;
    settings.height = 1400;
    settings.scatter = true;
    renderer::Offscreen renderer = render(plane(), settings);
    renderer::EffectSettings brute = settings;
    brute.technique = NACRE_TECHNIQUE_BRUTE;
    int refusals = 0;
    for (int attempt = 0; attempt < 2; ++attempt) {
        try {
            renderer.setEffect(brute);
        } catch (const renderer::RendererError& error) {
            EXPECT_NE(std::string(error.what()).find("maxStorageBufferRange"), std::string::npos) << error.what();
            ++refusals;
        }
    }
    EXPECT_NE(refusals, 1);
    if (refusals > 0) {
        EXPECT_NO_THROW(renderer.render(plane().cameras[0]));
    }
}

TEST_F(Errors, Cameras) {
    const auto refuse = [](const std::function<void(scene::Camera&)>& change, const std::string& word) {
        scene::Scene scene = plane();
        change(scene.cameras[0]);
        expectRefused(scene, plainSettings(), {"camera", word});
    };
    refuse([](scene::Camera& camera) { camera.target = camera.position; }, "target");
    refuse([](scene::Camera& camera) { camera.verticalFieldOfView = 4; }, "verticalFieldOfView");
    refuse([](scene::Camera& camera) { camera.position.x = std::numeric_limits<float>::quiet_NaN(); }, "position");
    refuse([](scene::Camera& camera) { camera.nearPlane = 5, camera.farPlane = 1; }, "nearPlane at 5, which is not");
    refuse([](scene::Camera& camera) { camera.nearPlane = 50; }, "nearPlane at 50, behind the scene");
    refuse([](scene::Camera& camera) { camera.farPlane = 1e-8f; }, "farPlane at 1e-08, before the scene");
}

TEST_F(Errors, ScenesThatDoNotHoldTogether) {
    scene::Scene scene = plane();
    scene.meshes[0].indices[0] = 77;
    expectRefused(scene, plainSettings(), {"mesh 'square'", "indices"});
    scene = plane();
    scene.surfaces[0].material = 3;
    expectRefused(scene, plainSettings(), {"material 3"});
    scene = plane();
    scene.surfaces[0].baseColorTexture = 0;
    expectRefused(scene, plainSettings(), {"texture 0"});
    scene = plane();
    scene.materials.push_back(Material{.name = "empty", .description = {}});
    expectRefused(scene, plainSettings(), {"material 'empty'"});
    scene = plane();
    scene.lights[0].direction = glm::vec3(0);
    expectRefused(scene, plainSettings(), {"light 'sun'", "direction"});
    scene = plane();
    scene.lights.assign(1025, scene.lights[0]);
    expectRefused(scene, plainSettings(), {"1025 lights", "1024"});
    scene = plane();
    scene.metersPerUnit = 0;
    expectRefused(scene, plainSettings(), {"metersPerUnit"});
}

TEST_F(Errors, DevicesThatAreNotThere) {
    const std::vector<renderer::DeviceDescription> devices = renderer::listDevices();
    ASSERT_FALSE(devices.empty());
    for (const char* name : {"99", "no such device"}) {
        try {
            renderer::Device opened({.name = name});
            FAIL() << opened.description().name;
        } catch (const renderer::RendererError& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }
    EXPECT_EQ(renderer::Device({.name = "0"}).description().name, devices[0].name);
    EXPECT_EQ(renderer::Device({.name = devices[0].name.substr(0, 4)}).description().name.substr(0, 4),
              devices[0].name.substr(0, 4));
}

TEST_F(Errors, ReadingAThicknessThatNobodyAskedFor) {
    const renderer::Offscreen renderer = render(plane(), plainSettings());
    EXPECT_THROW(renderer.read(renderer::Output::Thickness), renderer::RendererError);
    EXPECT_NO_THROW(renderer.read(renderer::Output::Transmitted));
}

TEST_F(Errors, ReadingBeforeRendering) {
    const renderer::Offscreen renderer(device(), plane(), plainSettings());
    EXPECT_THROW(renderer.read(renderer::Output::Color), renderer::RendererError);
}

} // namespace
} // namespace nacre::tests
