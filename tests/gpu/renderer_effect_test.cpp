// The whole pipeline with the effect: transmission through slabs, energy, switches, costs.
#include "tests/gpu/support/renderer_scenes.hpp"

#include <algorithm>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class Effect : public RendererTest {};

constexpr float meters = 1e-3f; ///< per millimetre

Material layered(double translucency) {
    Material material{.name = "layered", .description = {}};
    material.layers = {{{0.5, 0.3, 0.2}, 0.5}, {{0.3, 0.5, 0.2}, 4}, {{0.2, 0.2, 0.6}, 20}};
    material.translucency = translucency;
    return material;
}

/// A slab of 240 by 240 mm that faces the camera.
scene::Scene slab(float thickness, const Material& material) {
    scene::Scene scene = darkScene(0.5f);
    add(scene, box({240 * meters, 240 * meters, thickness * meters})).material = 0;
    scene.materials.push_back(material);
    return scene;
}

renderer::RenderSettings effectSettings() {
    renderer::RenderSettings settings = plainSettings();
    settings.shadowMapSize = 1024;
    settings.scatter = settings.transmit = true;
    return settings;
}

/// Light that reaches the front of a slab lit from behind, against E · translucency · (1 − CDF(d)).
void expectSlabTransmission(const scene::Light& light, float arriving) {
    const Material material = layered(0.5);
    const auto profile = makeProfile(material);
    renderer::RenderSettings settings = effectSettings();
    settings.technique = NACRE_TECHNIQUE_SEPARABLE; // what is scattered is not looked at, and bank takes long to make
    for (const float thickness : {1.0f, 2.0f, 4.0f, 8.0f}) {
        scene::Scene scene = slab(thickness, material);
        scene.lights.push_back(light);
        const Pixels transmitted = render(scene, settings).read(Output::Transmitted);
        for (int channel = 0; channel < 3; ++channel) {
            const float expected = 0.5f * arriving * static_cast<float>(profile->slabTransmittance(channel, thickness));
            EXPECT_NEAR(at(transmitted, 80, 45, static_cast<std::size_t>(channel)), expected, 0.02f * expected)
                << light.name << ", " << thickness << " mm, channel " << channel;
        }
    }
}

TEST_F(Effect, SlabUnderADirectionalLight) {
    expectSlabTransmission(directional({0, 0, 1}, 3), 3);
}

// Far away against the slab's thickness, so that the light is as strong on both sides.
TEST_F(Effect, SlabUnderASpotLight) {
    scene::Light light = spot({0, 0, -2}, {0, 0, 1}, 12);
    light.innerConeAngle = 0.08f;
    light.outerConeAngle = 0.1f;
    expectSlabTransmission(light, 3);
}

TEST_F(Effect, SlabUnderAPointLight) {
    scene::Light light = point({0, 0, -1}, 3);
    expectSlabTransmission(light, 3);
}

TEST_F(Effect, LightsWithoutShadowMapNeverGlow) {
    scene::Scene scene = slab(2, layered(0.5));
    scene.lights.push_back(directional({0, 0, 1}, 3));
    scene.lights[0].castsShadow = false;
    EXPECT_EQ(at(render(scene, effectSettings()).read(Output::Transmitted), 80, 45), 0);
    // Unless the thickness is authored.
    scene.surfaces[0].thickness = 2;
    renderer::RenderSettings settings = effectSettings();
    settings.thickness = true;
    const renderer::Offscreen authored = render(scene, settings);
    EXPECT_GT(at(authored.read(Output::Transmitted), 80, 45), 0.1f);
    EXPECT_NEAR(at(authored.read(Output::Thickness), 80, 45), 2, 0.01f);
}

double sum(const Pixels& pixels) {
    double result = 0;
    for (const float value : pixels.values) {
        result += value;
    }
    return result;
}

TEST_F(Effect, ScatterAndTransmitReturnNoMoreThanArrives) {
    // A sphere of albedo 1, lit from everywhere: what leaves it never exceeds what arrives.
    Material material = layered(0.5);
    scene::Scene scene = darkScene(0.2f);
    scene::Surface& surface = add(scene, sphere(0.03f, 32));
    surface.material = 0;
    surface.baseColor = glm::vec4(1);
    surface.specular = 0;
    scene.materials.push_back(material);
    for (const glm::vec3 direction : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0),
                                      glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
        scene.lights.push_back(directional(direction));
    }
    const renderer::Offscreen renderer = render(scene, effectSettings());
    const Pixels irradiance = renderer.read(Output::Irradiance);
    const Pixels scattered = renderer.read(Output::Scattered);
    const Pixels transmitted = renderer.read(Output::Transmitted);
    EXPECT_LE(sum(scattered), 1.01 * sum(irradiance));
    EXPECT_GE(sum(scattered), 0.9 * sum(irradiance));
    // The ball is many times as thick as the profile is wide, so that next to nothing comes through.
    EXPECT_LE(sum(scattered) + sum(transmitted), 1.01 * sum(irradiance));
    EXPECT_LE(sum(renderer.read(Output::Radiance)) * pi, 1.01 * sum(irradiance));
}

TEST_F(Effect, StrengthZeroIsTheEffectSwitchedOff) {
    Material material = layered(0);
    material.strength = 0;
    scene::Scene scene = darkScene(0.2f);
    add(scene, sphere(0.03f, 32)).material = 0;
    scene.materials.push_back(material);
    scene.lights.push_back(directional({-1, -1, -1}, 2));
    const Pixels on = render(scene, effectSettings()).read(Output::Radiance);
    const Pixels off = render(scene, plainSettings()).read(Output::Radiance);
    ASSERT_EQ(on.values.size(), off.values.size());
    // The two differ in their shadow maps' size, not where the light is not grazing.
    scene.lights[0].castsShadow = false;
    const Pixels onOpen = render(scene, effectSettings()).read(Output::Radiance);
    const Pixels offOpen = render(scene, plainSettings()).read(Output::Radiance);
    for (std::size_t i = 0; i < onOpen.values.size(); ++i) {
        ASSERT_NEAR(onOpen.values[i], offOpen.values[i], 2e-3f * offOpen.values[i] + 1e-4f) << i;
    }
}

TEST_F(Effect, PixelsWithoutAMaterialAreWhatTheyAreWithoutIt) {
    scene::Scene scene = slab(2, layered(0.5));
    add(scene, square(0.1f), glm::translate(glm::mat4(1), {0, 0, 0.05f}));
    scene.lights.push_back(directional({0, 0, -1}, 2));
    scene.lights[0].castsShadow = false;
    const renderer::Offscreen on = render(scene, effectSettings());
    const renderer::Offscreen off = render(scene, plainSettings());
    const Pixels id = on.read(Output::Material);
    std::size_t withMaterial = 0;
    std::size_t withoutMaterial = 0;
    for (const Output output : {Output::Scattered, Output::Radiance}) {
        const Pixels with = on.read(output);
        const Pixels without = off.read(output);
        for (std::size_t i = 0; i < with.values.size(); ++i) {
            const bool hasMaterial = id.values[i / 3] != 0;
            ++(hasMaterial ? withMaterial : withoutMaterial);
            ASSERT_TRUE(hasMaterial || with.values[i] == without.values[i]) << i;
        }
    }
    EXPECT_GT(withoutMaterial, 0);
    EXPECT_GT(withMaterial, 0);
}

TEST_F(Effect, ColoursAreAppliedOnceWithEitherAlbedoUse) {
    for (const AlbedoUse use : {AlbedoUse::Post, AlbedoUse::PreAndPost}) {
        Material material = layered(0);
        material.albedoUse = use;
        scene::Scene scene = slab(20, material);
        scene.surfaces[0].baseColor = {0.25f, 0.5f, 0.75f, 1};
        scene.surfaces[0].specular = 0;
        scene.lights.push_back(directional({0, 0, -1}, 2));
        const renderer::Offscreen renderer = render(scene, effectSettings());
        const Pixels radiance = renderer.read(Output::Radiance);
        const Pixels scattered = renderer.read(Output::Scattered);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            // The middle of an evenly lit face: scattering changes nothing.
            const float albedo = 0.25f * static_cast<float>(channel + 1);
            EXPECT_NEAR(at(scattered, 80, 45, channel), 2, 0.02f);
            EXPECT_NEAR(at(radiance, 80, 45, channel), 2 * albedo / pi, 0.01f * 2 * albedo / pi);
        }
    }
}

TEST_F(Effect, CostDoesNotDependOnMaterialsOrLayers) {
    std::vector<std::uint32_t> dispatches;
    for (const auto& [materials, layers] : {std::pair(1, 1), std::pair(1, 10), std::pair(64, 10)}) {
        scene::Scene scene = darkScene(0.2f);
        for (int i = 0; i < materials; ++i) {
            Material material{.name = "material", .description = {}};
            for (int layer = 0; layer < layers; ++layer) {
                material.layers.push_back({{1, 1, 1}, 0.1 * (layer + 1)});
            }
            scene.materials.push_back(material);
            const float x = 0.01f * static_cast<float>(i % 8) - 0.035f;
            const float y = 0.01f * static_cast<float>(i / 8) - 0.035f;
            add(scene, square(0.01f), glm::translate(glm::mat4(1), {x, y, 0})).material = static_cast<std::uint32_t>(i);
        }
        scene.lights.push_back(directional({0, 0, -1}));
        const renderer::Offscreen renderer = render(scene, effectSettings());
        EXPECT_EQ(renderer.report().materials, materials);
        dispatches.push_back(renderer.report().scatterDispatches);
        dispatches.push_back(renderer.report().transmitDispatches);
        const Pixels id = renderer.read(Output::Material);
        EXPECT_EQ(*std::max_element(id.values.begin(), id.values.end()), static_cast<float>(materials));
    }
    EXPECT_GT(dispatches[0], 0);
    EXPECT_EQ(dispatches[0], dispatches[2]);
    EXPECT_EQ(dispatches[0], dispatches[4]);
    EXPECT_EQ(dispatches[1], dispatches[3]);
    EXPECT_EQ(dispatches[1], dispatches[5]);
}

TEST_F(Effect, MaterialsCanBeReplaced) {
    scene::Scene scene = slab(2, layered(0));
    scene.lights.push_back(directional({0, 0, 1}, 3));
    renderer::Offscreen renderer = render(scene, effectSettings());
    EXPECT_EQ(at(renderer.read(Output::Transmitted), 80, 45), 0);
    renderer.setMaterials({layered(0.5)});
    renderer.render(scene.cameras[0]);
    EXPECT_GT(at(renderer.read(Output::Transmitted), 80, 45), 0.1f);
    EXPECT_THROW(renderer.setMaterials({}), renderer::RendererError);
}

TEST_F(Effect, EveryPassIsTimed) {
    scene::Scene scene = slab(2, layered(0.5));
    scene.lights.push_back(directional({0, 0, 1}, 3));
    const renderer::Offscreen renderer = render(scene, effectSettings());
    const renderer::FrameReport& report = renderer.report();
    double total = 0;
    for (const renderer::PassTime& pass : report.passes) {
        EXPECT_GE(pass.microseconds, 0) << pass.name;
        total += pass.microseconds;
    }
    EXPECT_GT(total, 0);
    // Between the passes there are barriers, which a busy machine may draw out.
    EXPECT_LE(total, 1.001 * report.totalMicroseconds);
    EXPECT_GE(total, 0.7 * report.totalMicroseconds);
    const auto has = [&](const std::string& prefix) {
        return std::any_of(report.passes.begin(), report.passes.end(),
                           [&](const renderer::PassTime& pass) { return pass.name.starts_with(prefix); });
    };
    for (const char* name : {"shadow maps", "G-buffer", "lighting", "transmit", "scatter", "compose", "tone map"}) {
        EXPECT_TRUE(has(name)) << name;
    }
}

TEST_F(Effect, FrameCanBeTimedAsAWhole) {
    scene::Scene scene = slab(2, layered(0.5));
    scene.lights.push_back(directional({0, 0, 1}, 3));
    renderer::Offscreen renderer = render(scene, effectSettings());
    const renderer::Pixels byPass = renderer.read(Output::Color);
    renderer.render(scene.cameras[0], renderer::Timing::Whole);
    EXPECT_TRUE(renderer.report().passes.empty());
    EXPECT_GT(renderer.report().totalMicroseconds, 0);
    EXPECT_EQ(renderer.read(Output::Color).values, byPass.values);
    renderer.render(scene.cameras[0]);
    EXPECT_FALSE(renderer.report().passes.empty());
}

TEST_F(Effect, CanBeRepeatedWithoutTimestampsInside) {
    scene::Scene scene = slab(2, layered(0.5));
    scene.lights.push_back(directional({0, 0, 1}, 3));
    renderer::RenderSettings settings = effectSettings();
    settings.effectRepetitions = 3;
    settings.copyFloor = true;
    renderer::Offscreen renderer = render(scene, settings);
    const renderer::Pixels once = renderer.read(Output::Scattered);
    renderer.renderEffect();
    const std::size_t passCount = renderer.report().passes.size();
    double effect = 0;
    double copy = 0;
    for (const renderer::PassTime& pass : renderer.report().passes) {
        (pass.name == "copy" ? copy : effect) += pass.microseconds;
    }
    EXPECT_DOUBLE_EQ(renderer.report().effectMicroseconds, effect);
    EXPECT_DOUBLE_EQ(renderer.report().copyMicroseconds, copy);
    renderer.renderEffect(3);
    EXPECT_EQ(renderer.report().passes.size(), passCount);
    EXPECT_GT(renderer.report().effectMicroseconds, 0.02 * effect); // of one, not of none
    EXPECT_GT(renderer.report().copyMicroseconds, 0);
    EXPECT_EQ(renderer.read(Output::Scattered).values, once.values);
    EXPECT_THROW(renderer.renderEffect(4), renderer::RendererError);
}

} // namespace
} // namespace nacre::tests
