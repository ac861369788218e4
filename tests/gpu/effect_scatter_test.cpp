// What every scatter technique owes its user: nothing leaks, nothing is lost, and a material looks the same however it
// is seen.
#include "tests/gpu/support/counted_calls.hpp"
#include "tests/gpu/support/effect.hpp"
#include "tests/support/synthetic_scenes.hpp"
#include "tests/support/worst.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr NacreTechnique techniques[] = {NACRE_TECHNIQUE_SEPARABLE, NACRE_TECHNIQUE_BRUTE, NACRE_TECHNIQUE_BANK,
                                         NACRE_TECHNIQUE_BURLEY, NACRE_TECHNIQUE_BANK_SURFACES};

class ScatterTest : public GpuTest, public testing::WithParamInterface<NacreTechnique> {
protected:
    NacreContextInfo contextInfo(VkExtent2D extent) const {
        NacreContextInfo info = gpu.contextInfo(extent);
        info.techniques = 1u << GetParam();
        return info;
    }
    std::vector<Float4> scatter(const ScatterInput& input, std::span<const Material> materials,
                                const ScatterFormats& formats = {}) {
        Effect& effect = shared();
        effect.setMaterials(materials);
        return effect.scatter(input, GetParam(), formats);
    }
    /// One context a technique for all tests: compiling its pipelines takes a software device long.
    Effect& shared() {
        static std::map<NacreTechnique, std::unique_ptr<Effect>> effects;
        std::unique_ptr<Effect>& effect = effects[GetParam()];
        if (!effect) {
            effect = std::make_unique<Effect>(gpu, contextInfo({192, 192}));
        }
        return *effect;
    }
    std::vector<Float4> scatter(const ScatterInput& input, const Material& material) {
        return scatter(input, std::span(&material, 1));
    }
};

/// 64 x 48 px at 2 px per mm, light and dark in blocks, as a start for variations.
ScatterInput blocks() {
    ScatterInput input = ScatterInput::plane(64, 48, Projection::perspective(64, 48, 1000), 500);
    for (std::uint32_t y = 0; y < 48; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            const float light = (x / 8 + y / 8) % 2 != 0 ? 1.0f : 0.1f;
            input.irradiance[input.index(x, y)] = {light, 0.5f * light, 0.25f * light, 1};
        }
    }
    return input;
}

float largestDifference(std::span<const Float4> a, std::span<const Float4> b) {
    float largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            largest = larger(largest, std::abs(a[i][channel] - b[i][channel]));
        }
    }
    return largest;
}

TEST_P(ScatterTest, ConstantFieldStaysConstantBesideAbsurdlyBrightPixels) {
    for (const SceneKind kind : {SceneKind::Thin, SceneKind::Spheres}) {
        const ScatterScene scene = makeScatterScene({.kind = kind, .footprint = 12, .width = 128, .height = 72});
        ScatterInput input = ScatterInput::plane(128, 72, Projection::perspective(128, 72, scene.focalLength), 1);
        for (std::size_t i = 0; i < scene.depth.size(); ++i) {
            input.depth[i] = static_cast<float>(scene.depth[i]);
            input.materialId[i] = scene.materialId[i];
            const float light = scene.materialId[i] != 0 ? 0.5f : 1e4f;
            input.irradiance[i] = {light, light, light, 1};
        }
        const std::vector<Float4> result = scatter(input, scene.materials);
        for (std::size_t i = 0; i < result.size(); ++i) {
            const float expected = input.irradiance[i][0];
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(result[i][channel], expected, 1e-3f * expected) << scene.name << " pixel " << i;
            }
        }
    }
}

TEST_P(ScatterTest, NoLightAcrossDepthDiscontinuities) {
    for (const bool frontIsBright : {true, false}) {
        ScatterInput input = ScatterInput::plane(96, 40, Projection::perspective(96, 40, 1000), 500);
        for (std::uint32_t y = 0; y < 40; ++y) {
            for (std::uint32_t x = 0; x < 96; ++x) {
                const bool isFront = x < 48;
                const float light = isFront == frontIsBright ? 10.0f : 0.0f;
                input.depth[input.index(x, y)] = isFront ? 500.0f : 520.0f;
                input.irradiance[input.index(x, y)] = {light, light, light, 1};
            }
        }
        const std::vector<Float4> result = scatter(input, skin());
        for (std::size_t i = 0; i < result.size(); ++i) {
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(result[i][channel], input.irradiance[i][channel], 1e-2f) << "pixel " << i;
            }
        }
    }
}

TEST_P(ScatterTest, PixelsWithoutSubsurfaceAreCopied) {
    ScatterInput input = blocks();
    for (std::size_t i = 0; i < input.materialId.size(); i += 3) {
        input.materialId[i] = i % 2 != 0 ? 0 : 9; // 9 was never set
        input.irradiance[i] = {7, 8, 9, 1};
    }
    const std::vector<Float4> result = scatter(input, skin());
    for (std::size_t i = 0; i < result.size(); i += 3) {
        ASSERT_EQ(result[i], input.irradiance[i]);
    }
}

/// A camera on the plane with a shadow edge at 0 mm.
struct Camera {
    const char* name;
    Projection projection;
    float depth;
    double pixelsPerMillimetre;
    double centerX; ///< px, where 0 mm is
    std::uint32_t size;
};

TEST_P(ScatterTest, SameLightPerAreaHoweverItIsSeen) {
    const Camera cameras[] = {
        {"base", Projection::perspective(96, 96, 1000), 500, 2, 48, 96},
        {"half the distance", Projection::perspective(192, 192, 1000), 250, 4, 96, 192},
        {"twice the resolution", Projection::perspective(192, 192, 2000), 500, 4, 96, 192},
        {"another field of view", Projection::perspective(96, 96, 250), 125, 2, 48, 96},
        {"orthographic", Projection::orthographic(96, 96, 2), 500, 2, 48, 96},
        {"off-centre", Projection::perspective(96, 96, 1000, 40, 70), 500, 2, 40, 96},
    };
    const Material material = marble();
    const auto profile = makeProfile(material);
    const double tolerance = GetParam() == NACRE_TECHNIQUE_BURLEY ? 0.03 : 0.02; // noise of 64 samples
    for (const Camera& camera : cameras) {
        ScatterInput input = ScatterInput::plane(camera.size, camera.size, camera.projection, camera.depth);
        for (std::uint32_t y = 0; y < camera.size; ++y) {
            for (std::uint32_t x = 0; x < camera.size; ++x) {
                const float light = x >= camera.centerX ? 1.0f : 0.0f;
                input.irradiance[input.index(x, y)] = {light, light, light, 1};
            }
        }
        const std::vector<Float4> result = scatter(input, material);
        for (std::uint32_t x = 0; x < camera.size; ++x) {
            const double position = (x + 0.5 - camera.centerX) / camera.pixelsPerMillimetre;
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(result[input.index(x, camera.size / 2)][channel],
                            profile->lineSpreadCumulative(channel, position), tolerance)
                    << camera.name << " at " << position << " mm";
            }
        }
    }
}

// An orthographic camera may see what lies behind it, too.
TEST_P(ScatterTest, SeesTheSameWhereverAnOrthographicCameraStands) {
    const Material material = skin();
    ScatterInput input = blocks();
    for (std::size_t i = 0; i < input.depth.size(); ++i) {
        input.depth[i] = i % 64 < 40 ? 0.05f : 0.06f; // 500 and 600 mm behind the near plane
    }
    std::vector<Float4> expected;
    for (const float near : {0.0f, 500.0f, 800.0f}) { // behind the camera, mm
        Projection projection = Projection::orthographic(input.extent.width, input.extent.height, 2);
        projection.clipFromView[14] = 1e-4f * near;
        input.view = makeView(projection);
        input.view.depthEncoding = NACRE_DEPTH_HARDWARE;
        const std::vector<Float4> result = scatter(input, material);
        expected = expected.empty() ? result : expected;
        EXPECT_LT(largestDifference(expected, result), 2e-3f) << "near plane " << near << " mm behind the camera";
    }
    EXPECT_GT(largestDifference(expected, input.irradiance), 0.1f);
}

TEST_P(ScatterTest, CostDoesNotDependOnMaterialsOrLayers) {
    Material tenLayers = skin();
    for (int i = 0; i < 4; ++i) {
        tenLayers.layers.push_back({{0.01, 0.02, 0.03}, 0.1 * (i + 1)});
    }
    Material oneLayer = skin();
    oneLayer.layers.resize(1);
    const std::vector<Material> many(64, tenLayers);
    const std::vector<std::span<const Material>> sets = {{&oneLayer, 1}, {&tenLayers, 1}, many};
    ScatterInput input = blocks();
    for (std::size_t i = 0; i < input.materialId.size(); ++i) {
        input.materialId[i] = static_cast<std::uint16_t>(1 + i % 64);
    }
    NacreContextInfo info = contextInfo(input.extent);
    info.getInstanceProcAddr = countingGetInstanceProcAddr;
    Effect effect(gpu, info);
    for (const std::span<const Material> materials : sets) {
        effect.setMaterials(materials);
        NacreCost cost{};
        ASSERT_EQ(nacreGetScatterCost(effect.context, GetParam(), &cost), NACRE_SUCCESS);
        callCounts() = {};
        effect.scatter(input, GetParam());
        EXPECT_EQ(callCounts().dispatches, static_cast<int>(cost.dispatchCount));
        EXPECT_EQ(callCounts().allocations, 0) << "recording allocates nothing";
        EXPECT_EQ(cost.dispatchCount, cost.passCount);
        EXPECT_EQ(cost.intermediateBytes > 0, GetParam() != NACRE_TECHNIQUE_BURLEY); // it has one pass
    }
}

TEST_P(ScatterTest, EveryFormatGivesTheSamePicture) {
    const ScatterInput input = blocks();
    const Material material = skin();
    const std::vector<Float4> expected = scatter(input, material);
    const std::span materials(&material, 1);
    EXPECT_EQ(largestDifference(expected, scatter(input, materials, {.materialId = VK_FORMAT_R8_UINT})), 0.0f);
    EXPECT_LT(largestDifference(expected, scatter(input, materials, {.irradiance = VK_FORMAT_R16G16B16A16_SFLOAT})),
              1e-3f);
    EXPECT_LT(largestDifference(expected, scatter(input, materials, {.irradiance = VK_FORMAT_B10G11R11_UFLOAT_PACK32})),
              0.03f);
    EXPECT_LT(largestDifference(expected, scatter(input, materials, {.scattered = VK_FORMAT_R16G16B16A16_SFLOAT})),
              1e-3f);
    EXPECT_LT(largestDifference(expected, scatter(input, materials, {.scattered = VK_FORMAT_B10G11R11_UFLOAT_PACK32})),
              0.03f);
}

TEST_P(ScatterTest, HardwareDepthGivesTheSamePicture) {
    ScatterInput input = blocks();
    for (std::size_t i = 0; i < input.depth.size(); ++i) {
        input.depth[i] = 480.0f + 0.5f * static_cast<float>(i % 64);
    }
    const Material material = skin();
    const std::vector<Float4> expected = scatter(input, material);
    // Conventional, reversed, and reversed infinite perspective: clip z = a·z + b, w = -z.
    const std::array<float, 2> rows[] = {
        {-1000.0f / 900.0f, -1000.0f * 100.0f / 900.0f}, {100.0f / 900.0f, 1000.0f * 100.0f / 900.0f}, {0.0f, 100.0f}};
    for (const auto& [a, b] : rows) {
        for (const VkFormat format : {VK_FORMAT_R32_SFLOAT, VK_FORMAT_D32_SFLOAT}) {
            ScatterInput hardware = input;
            hardware.view.depthEncoding = NACRE_DEPTH_HARDWARE;
            hardware.view.clipFromView[10] = a;
            hardware.view.clipFromView[14] = b;
            for (float& depth : hardware.depth) {
                depth = (-a * depth + b) / depth;
            }
            EXPECT_LT(largestDifference(expected, scatter(hardware, std::span(&material, 1), {.depth = format})),
                      2e-3f);
        }
    }
}

TEST_P(ScatterTest, RenderAreaIsItsOwnPicture) {
    const ScatterInput whole = blocks();
    const Material material = skin();
    const VkRect2D area{{16, 8}, {32, 24}};
    ScatterInput cut = ScatterInput::plane(32, 24, Projection::perspective(32, 24, 1000), 500);
    for (std::uint32_t y = 0; y < 24; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
            cut.irradiance[cut.index(x, y)] = whole.irradiance[whole.index(x + 16, y + 8)];
        }
    }
    ScatterInput part = whole;
    part.view = cut.view;
    part.view.renderArea = area;
    const std::vector<Float4> expected = scatter(cut, material);
    const std::vector<Float4> result = scatter(part, material);
    for (std::uint32_t y = 0; y < 24; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(result[part.index(x + 16, y + 8)][channel], expected[cut.index(x, y)][channel], 1e-4f);
            }
        }
    }
}

TEST_P(ScatterTest, ValuesThatAreNotFiniteStayWhereTheyAre) {
    const Material material = skin();
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
    for (const float value : bad) {
        ScatterInput input = blocks();
        const std::vector<Float4> clean = scatter(input, material);
        const std::size_t light = input.index(30, 20);
        input.irradiance[light] = {value, value, value, 1};
        input.depth[input.index(40, 30)] = value;
        const std::vector<Float4> result = scatter(input, material);
        for (std::uint32_t y = 0; y < 48; ++y) {
            for (std::uint32_t x = 0; x < 64; ++x) {
                for (int channel = 0; channel < 3; ++channel) {
                    ASSERT_TRUE(std::isfinite(result[input.index(x, y)][channel])) << x << ", " << y;
                }
            }
        }
        // Further away than the radius (16 px here, times two passes) nothing has changed.
        for (const std::uint32_t x : {0u, 4u, 8u}) {
            EXPECT_NEAR(result[input.index(x, 0)][0], clean[input.index(x, 0)][0], 1e-4f);
        }
    }
}

TEST_P(ScatterTest, ExchangeGroupsDecideWhoGivesLightToWhom) {
    ScatterInput input = ScatterInput::plane(64, 32, Projection::perspective(64, 32, 1000), 500);
    for (std::uint32_t y = 0; y < 32; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
            input.irradiance[input.index(x, y)] = {0, 0, 0, 1};
            input.materialId[input.index(x, y)] = 2;
        }
    }
    const auto darkSide = [&](std::uint32_t left, std::uint32_t right) {
        Effect& effect = shared();
        std::vector<NacreLayer> storage;
        NacreMaterial materials[2] = {toNacre(skin(), storage), toNacre(skin(), storage)};
        materials[0].exchangeGroups = right;
        materials[1].exchangeGroups = left;
        EXPECT_EQ(nacreSetMaterials(effect.context, 1, 2, materials), NACRE_SUCCESS);
        return effect.scatter(input, GetParam())[input.index(31, 16)][0];
    };
    EXPECT_GT(darkSide(1, 1), 0.1f);
    EXPECT_GT(darkSide(6, 2), 0.1f);
    EXPECT_EQ(darkSide(1, 2), 0.0f);
    EXPECT_EQ(darkSide(0, 0), 0.0f);
}

// Light times albedo, or times its square root.
std::vector<Float4> colored(std::vector<Float4> light, std::span<const Float4> albedo, bool root) {
    for (std::size_t i = 0; i < light.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            light[i][channel] *= root ? std::sqrt(albedo[i][channel]) : albedo[i][channel];
        }
    }
    return light;
}

TEST_P(ScatterTest, AlbedoAndStrengthAreApplied) {
    ScatterInput input = blocks();
    std::vector<Float4> albedo;
    for (std::size_t i = 0; i < input.depth.size(); ++i) {
        albedo.push_back(i % 64 / 4 % 2 != 0 ? Float4{0.25f, 0.5f, 0.75f, 1} : Float4{1, 0.04f, 0.5f, 1});
    }
    const std::vector<Float4> plain = scatter(input, skin());
    ScatterInput before = input;
    before.irradiance = colored(input.irradiance, albedo, true);
    const std::vector<Float4> afterBoth = colored(scatter(before, skin()), albedo, true);
    input.albedo = albedo;
    for (const AlbedoUse use : {AlbedoUse::Post, AlbedoUse::PreAndPost, AlbedoUse::Post}) {
        Material material = skin();
        material.albedoUse = use;
        const std::vector<Float4> expected = use == AlbedoUse::Post ? colored(plain, albedo, false) : afterBoth;
        EXPECT_LT(largestDifference(scatter(input, material), expected), 1e-3f);
    }
}

// By a material, by an image, by both, and by none again.
TEST_P(ScatterTest, StrengthIsTheMaterialsTimesTheImages) {
    ScatterInput input = blocks();
    const std::vector<Material> full(2, skin());
    const std::vector<Float4> plain = scatter(input, full);
    const auto expectShare = [&](double material, float image, float share) {
        std::vector<Material> materials = full;
        materials[0].strength = material; // the other's stays 1, and no pixel has it
        input.strength.assign(image < 1 ? input.depth.size() : 0, image);
        const std::vector<Float4> result = scatter(input, materials);
        for (std::size_t i = 0; i < result.size(); ++i) {
            const float expected = (1 - share) * input.irradiance[i][0] + share * plain[i][0];
            ASSERT_NEAR(result[i][0], expected, 1e-3f) << material << " of the material, " << image << " of the image";
        }
    };
    expectShare(0.5, 1, 0.5f);
    expectShare(1, 0.5f, 0.5f);
    expectShare(0.5, 0.5f, 0.25f);
    input.strength.clear();
    EXPECT_EQ(scatter(input, full), plain);
}

INSTANTIATE_TEST_SUITE_P(Techniques, ScatterTest, testing::ValuesIn(techniques), [](const auto& technique) {
    std::string name = nacreTechniqueString(technique.param);
    std::ranges::replace(name, '-', '_');
    return name;
});

} // namespace
