// Frames in flight: recording makes, submits and waits for nothing, and each frame is what it would be alone.
#include "tests/gpu/support/frame_driver.hpp"
#include "tests/gpu/support/recording_calls.hpp"
#include "tests/gpu/support/renderer_scenes.hpp"

#include <cstdlib>
#include <functional>
#include <utility>

namespace nacre::tests {
namespace {

using renderer::FrameView;
using renderer::RenderSettings;

class Frames : public RendererTest {};

Material wax(double variance, double translucency) {
    Material material{.name = "wax", .description = {}};
    material.layers = {{.weight = {1, 1, 1}, .variance = variance}};
    material.translucency = translucency;
    material.secondSurfaces = false;
    return material;
}

/// A translucent sphere over a ground, a box with holes beside it, glass before it, a light of each kind.
scene::Scene makeScene() {
    scene::Scene scene = darkScene(3);
    scene.environment.intensity = 0.2f;
    scene.metersPerUnit = 0.1;
    scene.materials = {wax(40, 0.5)};
    add(scene, square(4), glm::translate(glm::mat4(1), {0, 0, -0.6f}));
    add(scene, sphere(0.5f, 24)).material = 0;
    scene::Surface& holes = add(scene, box(glm::vec3(0.4f)), glm::translate(glm::mat4(1), {0.8f, 0, 0}));
    holes.alphaMode = scene::AlphaMode::Mask;
    holes.baseColor.a = 0.4f;
    holes.alphaCutoff = 0.3f;
    scene::Surface& glass = add(scene, sphere(0.3f, 8), glm::translate(glm::mat4(1), {-0.3f, 0.1f, 0.7f}));
    glass.alphaMode = scene::AlphaMode::Blend;
    glass.baseColor.a = 0.2f;
    glass.doubleSided = true;
    scene.lights = {directional({0.3f, -0.5f, -1}, 2), spot({-1, 1, 2}, {0.5f, -0.5f, -1}, 0.05f),
                    point({0.2f, 0.3f, -0.5f}, 0.005f)};
    scene.lights[2].range = 0.5f;
    return scene;
}

RenderSettings frameSettings() {
    RenderSettings settings = plainSettings();
    settings.shadowMapSize = 128;
    settings.scatter = settings.transmit = true;
    return settings;
}

/// What the driver may change, frame by frame.
struct State {
    scene::Scene scene;
    RenderSettings settings = frameSettings();
    FrameView view;
};

/// Frame `i` of a scene in which everything moves that may.
State stateOf(int i) {
    const auto t = static_cast<float>(i);
    State state{.scene = makeScene(), .view = {}};
    scene::Scene& scene = state.scene;
    scene.cameras[0].position += glm::vec3(0.1f * t, 0.05f * t, 0);
    scene.lights[0].direction.x += 0.1f * t;
    scene.lights[1].position.x += 0.2f * t;
    scene.lights[2].intensity *= 1 + 0.3f * t;
    if (i % 3 == 2) {
        scene.lights.pop_back();
    }
    scene.materials[0] = wax(10 + 20 * i, 0.1 * (1 + i));
    scene.materials[0].albedoUse = i % 2 == 0 ? AlbedoUse::Post : AlbedoUse::PreAndPost;
    scene.surfaces[0].baseColor = {0.2f + 0.1f * t, 0.5f, 0.9f - 0.1f * t, 1};
    scene.surfaces[0].roughness = 0.2f + 0.1f * t;
    scene.surfaces[1].specular = 0.1f * t;
    scene.surfaces[1].emission = glm::vec3(0.02f * t);
    scene.surfaces[2].metallic = 0.15f * t;
    scene.surfaces[2].alphaCutoff = i == 4 ? 0.5f : 0.3f;
    scene.surfaces[3].baseColor.a = 0.2f + 0.1f * t;
    scene.exposure = 1 + 0.1f * t;
    scene.environment.intensity = 0.2f + 0.05f * t;
    scene.environment.rotation = 0.5f * t;
    state.settings.transmit = i != 1;
    state.settings.technique = i == 3 ? NACRE_TECHNIQUE_SEPARABLE : NACRE_TECHNIQUE_DEFAULT;
    state.view = {scene.cameras[0], {0.1f * t - 0.2f, 0.25f - 0.1f * t}};
    return state;
}

void apply(const State& state, renderer::Frame& frame) {
    const scene::Scene& scene = state.scene;
    frame.setMaterials(scene.materials);
    frame.setSurfaces(scene.surfaces);
    frame.setLights(scene.lights);
    frame.setExposure(scene.exposure);
    frame.setEnvironment(scene.environment.intensity, scene.environment.rotation);
    frame.setEffect(state.settings);
}

TEST(FramesInFlight, NeitherWaitNorAllocateAndEqualThoseDrawnAlone) {
    constexpr std::uint32_t inFlight = 3;
    constexpr int count = 6;
    renderer::Device own({.validation = true});
    std::vector<FramePicture> together(count);
    {
        countCalls(own);
        FrameDriver driver(own, makeScene(), frameSettings(), {.framesInFlight = inFlight});
        driver.frame.prepare(stateOf(3).settings);
        EXPECT_FALSE(forbiddenCalls().empty()) << "nothing is counted";
        EXPECT_GT(callCounts().allocations, 0) << "nothing of the effect is counted";
        callCounts() = {};
        for (int i = 0; i < count; ++i) {
            const auto index = static_cast<std::uint32_t>(i) % inFlight;
            if (i >= static_cast<int>(inFlight)) {
                together[i - inFlight] = driver.finish(index);
            }
            const State state = stateOf(i);
            forbiddenCalls().clear();
            apply(state, driver.frame);
            driver.record(index, state.view);
            EXPECT_EQ(forbiddenCalls(), std::vector<std::string>{}) << "frame " << i;
            driver.submit(index);
        }
        EXPECT_EQ(callCounts().allocations, 0);
        EXPECT_EQ(callCounts().waits, 0);
        EXPECT_GT(callCounts().dispatches, 0);
        for (int i = count - inFlight; i < count; ++i) {
            together[i] = driver.finish(static_cast<std::uint32_t>(i) % inFlight);
        }
        for (std::uint32_t index = 0; index < inFlight; ++index) {
            const renderer::FrameReport report = driver.frame.report(index);
            EXPECT_GT(report.totalMicroseconds, 0);
            EXPECT_FALSE(report.passes.empty());
            EXPECT_GT(report.subsurfaceCoverage, 0.02);
        }
    }
    for (int i = 0; i < count; ++i) {
        const State state = stateOf(i);
        FrameDriver alone(own, state.scene, state.settings);
        const FramePicture picture = alone.draw(state.view);
        EXPECT_TRUE(picture.color == together[i].color) << "frame " << i;
        EXPECT_TRUE(picture.radiance == together[i].radiance) << "frame " << i;
        for (int other = 0; other < i; ++other) {
            EXPECT_FALSE(together[other].radiance == together[i].radiance) << i << " looks like " << other;
        }
    }
    EXPECT_EQ(own.validationMessages(), std::vector<std::string>{});
}

TEST_F(Frames, ShadowMapsAreDrawnAgainOnlyWhenTheyHaveChanged) {
    scene::Scene scene = makeScene();
    FrameDriver driver(device(), scene, frameSettings());
    FrameView view{scene.cameras[0]};
    const auto layersDrawn = [&] {
        driver.draw(view);
        return driver.frame.report(0).shadowLayersDrawn;
    };
    EXPECT_EQ(layersDrawn(), 8u); // directional 1, spot 1, point 6
    EXPECT_EQ(layersDrawn(), 0u);
    view.camera.position.x += 0.5f;
    EXPECT_EQ(layersDrawn(), 0u);
    scene.lights[0].color = {1, 0.5f, 0.2f};
    scene.surfaces[0].baseColor.r = 0.1f;
    scene.materials[0].translucency = 0.9;
    driver.frame.setLights(scene.lights);
    driver.frame.setSurfaces(scene.surfaces);
    driver.frame.setMaterials(scene.materials);
    EXPECT_EQ(layersDrawn(), 0u);
    scene.lights[2].position.y += 0.1f;
    driver.frame.setLights(scene.lights);
    EXPECT_EQ(layersDrawn(), 6u);
    scene.lights[0].direction.x += 0.1f;
    driver.frame.setLights(scene.lights);
    EXPECT_EQ(layersDrawn(), 1u);
    scene.surfaces[2].alphaCutoff = 0.5f; // the box disappears
    driver.frame.setSurfaces(scene.surfaces);
    EXPECT_EQ(layersDrawn(), 8u);
    const FramePicture picture = driver.draw(view);
    EXPECT_EQ(driver.frame.report(0).shadowLayersDrawn, 0u);
    FrameDriver fresh(device(), scene, frameSettings());
    EXPECT_TRUE(fresh.draw(view) == picture);
}

TEST_F(Frames, AreDrawnWithAllShadowMapsWhereSettingsAskForIt) {
    const scene::Scene scene = makeScene();
    RenderSettings settings = frameSettings();
    settings.shadowMapsEveryFrame = true;
    FrameDriver driver(device(), scene, settings);
    driver.draw({scene.cameras[0]});
    driver.draw({scene.cameras[0]});
    EXPECT_EQ(driver.frame.report(0).shadowLayersDrawn, 8u);
}

TEST_F(Frames, CanChangeTheirSize) {
    const scene::Scene scene = makeScene();
    RenderSettings settings = frameSettings();
    FrameDriver driver(device(), scene, settings);
    driver.draw({scene.cameras[0]});
    for (const auto& [width, height] : {std::pair(97u, 61u), std::pair(200u, 120u)}) {
        driver.resize(width, height);
        const FramePicture resized = driver.draw({scene.cameras[0]});
        EXPECT_EQ(driver.frame.report(0).shadowLayersDrawn, 0u);
        settings.width = width;
        settings.height = height;
        FrameDriver fresh(device(), scene, settings);
        EXPECT_TRUE(fresh.draw({scene.cameras[0]}) == resized) << width;
    }
    EXPECT_THROW(driver.frame.resize(0, 10), renderer::RendererError);
    EXPECT_NO_THROW(driver.draw({scene.cameras[0]}));
}

TEST_F(Frames, SampleBesideThePixelsCentreWhenJittered) {
    const scene::Scene scene = makeScene();
    FrameDriver driver(device(), scene, frameSettings());
    // Half a pixel right of one pixel's centre is half a pixel left of the next one's; likewise down.
    const auto halves = [&](glm::vec2 jitter) {
        const FramePicture picture = driver.draw({scene.cameras[0], jitter});
        std::vector<int> red(160 * 90);
        for (std::size_t i = 0; i < red.size(); ++i) {
            red[i] = static_cast<int>(picture.color[4 * i]);
        }
        return red;
    };
    const auto mostlyEqual = [](const std::vector<int>& a, const std::vector<int>& b, std::size_t shift) {
        std::size_t equal = 0;
        for (std::size_t i = 0; i + shift < a.size(); ++i) {
            equal += std::abs(a[i] - b[i + shift]) <= 3 ? 1 : 0;
        }
        return static_cast<double>(equal) / static_cast<double>(a.size() - shift);
    };
    const std::vector<int> right = halves({0.5f, 0});
    const std::vector<int> left = halves({-0.5f, 0});
    EXPECT_GT(mostlyEqual(right, left, 1), 0.98);
    EXPECT_GT(mostlyEqual(halves({0, 0.5f}), halves({0, -0.5f}), 160), 0.98);
    EXPECT_NE(right, left);
}

TEST_F(Frames, RefuseWhatTheyWereNotMadeFor) {
    const scene::Scene scene = makeScene();
    FrameDriver driver(device(), scene, frameSettings());
    const FramePicture before = driver.draw({scene.cameras[0]});
    const auto refused = [&](const std::function<void(renderer::Frame&)>& action, const std::string& word) {
        try {
            action(driver.frame);
            ADD_FAILURE() << "nothing was refused: " << word;
        } catch (const renderer::RendererError& error) {
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    refused([&](renderer::Frame& frame) { frame.setLights(std::vector(4, scene.lights[0])); }, "3 lights");
    refused([&](renderer::Frame& frame) { frame.setLights(std::vector(3, scene.lights[2])); }, "18");
    refused([&](renderer::Frame& frame) { frame.setMaterials({}); }, "1 materials");
    refused([&](renderer::Frame& frame) { frame.setSurfaces({}); }, "4 surfaces");
    std::vector<scene::Surface> surfaces = scene.surfaces;
    surfaces[1].name = "ball";
    surfaces[1].doubleSided = true;
    refused([&](renderer::Frame& frame) { frame.setSurfaces(surfaces); }, "'ball'");
    RenderSettings brute = frameSettings();
    brute.technique = NACRE_TECHNIQUE_BRUTE;
    EXPECT_FALSE(driver.frame.isPrepared(brute));
    refused([&](renderer::Frame& frame) { frame.setEffect(brute); }, "not prepared");
    refused([&](renderer::Frame& frame) { frame.effectUse(1); }, "picture");
    EXPECT_TRUE(driver.draw({scene.cameras[0]}) == before);
    try {
        FrameDriver many(device(), scene, frameSettings(), {.framesInFlight = 9});
        ADD_FAILURE() << "nine frames in flight";
    } catch (const renderer::RendererError& error) {
        EXPECT_NE(std::string(error.what()).find("framesInFlight is 9"), std::string::npos) << error.what();
    }
}

TEST_F(Frames, ThatAreNotSubmittedLeaveNothingBehind) {
    const scene::Scene scene = makeScene();
    FrameDriver driver(device(), scene, frameSettings());
    driver.record(0, {scene.cameras[0]});
    driver.frame.discard();
    const FramePicture picture = driver.draw({scene.cameras[0]});
    EXPECT_EQ(driver.frame.report(0).shadowLayersDrawn, 8u);
    FrameDriver fresh(device(), scene, frameSettings());
    EXPECT_TRUE(fresh.draw({scene.cameras[0]}) == picture);
}

} // namespace
} // namespace nacre::tests
