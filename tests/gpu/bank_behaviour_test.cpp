// What techniques `bank` and `bank-surfaces` owe beyond their error: energy, stillness in motion, no leaks at any level
// of the pyramid.
#include "image/metrics.hpp"
#include "tests/gpu/support/scene_input.hpp"
#include "tests/support/worst.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

namespace nacre::tests {
namespace {

class BankBehaviourTest : public GpuTest, public ::testing::WithParamInterface<NacreTechnique> {
protected:
    std::unique_ptr<Effect> makeEffect(const ScatterScene& scene) { return makeEffect(scene, gpu.shaderFloat16); }
    std::unique_ptr<Effect> makeEffect(const ScatterScene& scene, VkBool32 shaderFloat16) {
        NacreContextInfo info = gpu.contextInfo({512, 512});
        info.techniques = 1u << GetParam();
        info.shaderFloat16 = shaderFloat16;
        auto effect = std::make_unique<Effect>(gpu, info);
        effect->setMaterials(scene.materials);
        return effect;
    }
    std::vector<Float4> scatter(Effect& effect, const ScatterScene& scene) {
        return effect.scatter(toInput(scene), GetParam());
    }
};

INSTANTIATE_TEST_SUITE_P(Techniques, BankBehaviourTest,
                         ::testing::Values(NACRE_TECHNIQUE_BANK, NACRE_TECHNIQUE_BANK_SURFACES),
                         [](const auto& technique) {
                             return technique.param == NACRE_TECHNIQUE_BANK ? "Bank" : "BankSurfaces";
                         });

// A plane of one material with lit discs far from the border: as much light leaves as enters.
TEST_P(BankBehaviourTest, LightIsNeitherLostNorMade) {
    for (const Material& material : testMaterials()) {
        for (const double footprint : {4.0, 20.0, 60.0}) {
            ScatterScene scene =
                makeScatterScene({.footprint = footprint, .width = 420, .height = 400, .materials = {material}});
            double entering[3] = {};
            for (int y = 0; y < scene.height; ++y) {
                for (int x = 0; x < scene.width; ++x) {
                    const bool lit = std::hypot(x - 201.3, y - 195.7) < 25 || std::hypot(x - 240.2, y - 211.1) < 3;
                    const std::size_t i = scene.index(x, y);
                    scene.materialId[i] = 1;
                    scene.irradiance[i] = lit ? Rgb{1, 0.7, 0.3} : Rgb{};
                    for (int channel = 0; channel < 3; ++channel) {
                        entering[channel] += scene.irradiance[i][channel];
                    }
                }
            }
            const auto effect = makeEffect(scene);
            double leaving[3] = {};
            for (const Float4& pixel : scatter(*effect, scene)) {
                for (int channel = 0; channel < 3; ++channel) {
                    leaving[channel] += pixel[channel];
                }
            }
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(leaving[channel] / entering[channel], 1, 5e-3)
                    << material.name << " at " << footprint << " px, channel " << channel;
            }
        }
    }
}

// Every kind of edge, every level in use, neighbours a million times as bright.
TEST_P(BankBehaviourTest, AConstantFieldStaysConstantBesideAbsurdlyBrightPixels) {
    for (const SceneKind kind : tunedSceneKinds) {
        for (const double footprint : {4.0, 60.0}) {
            ScatterScene scene = makeScatterScene({.kind = kind, .footprint = footprint, .width = 192, .height = 108});
            for (std::size_t i = 0; i < scene.irradiance.size(); ++i) {
                scene.irradiance[i] = scene.materialId[i] != 0 ? Rgb{0.5, 0.05, 5} : Rgb{5e5, 5e5, 5e5};
            }
            for (const VkBool32 shaderFloat16 : {VK_FALSE, gpu.shaderFloat16}) {
                const std::vector<Float4> result = scatter(*makeEffect(scene, shaderFloat16), scene);
                double largest = 0;
                for (std::size_t i = 0; i < result.size(); ++i) {
                    for (int channel = 0; channel < 3; ++channel) {
                        const double expected = scene.irradiance[i][channel];
                        const double deviation = std::abs(result[i][channel] - expected) / expected;
                        largest = larger(largest, deviation);
                    }
                }
                std::printf("%-10s constant within %.5f\n", scene.name.c_str(), largest);
                EXPECT_LE(largest, 1e-3) << scene.name;
            }
        }
    }
}

// The picture of a scene that moves by whole pixels against the pyramid's grid stays the same picture.
TEST_P(BankBehaviourTest, MovingByPixelsChangesLittle) {
    for (const SceneKind kind : tunedSceneKinds) {
        for (const double footprint : {20.0, 60.0}) {
            const int margin = static_cast<int>(1.2 * footprint) + 10;
            std::vector<ScatterScene> scenes;
            std::vector<std::vector<Float4>> pictures;
            double worst = 1e9;
            const auto effect = makeEffect(makeScatterScene({.width = 8, .height = 8}));
            for (int shift = 0; shift <= 7; ++shift) {
                scenes.push_back(makeScatterScene(
                    {.kind = kind, .footprint = footprint, .width = 288, .height = 224, .shift = double(shift)}));
                pictures.push_back(scatter(*effect, scenes.back()));
                if (shift == 0) {
                    continue;
                }
                double squares = 0;
                double count = 0;
                for (int y = margin; y + 1 < scenes[0].height - margin; ++y) {
                    for (int x = margin; x + 1 < scenes[0].width - margin; ++x) {
                        const std::size_t now = scenes[0].index(x, y);
                        const std::size_t before = scenes[0].index(x + 1, y + 1);
                        for (int channel = 0; scenes[shift].materialId[now] != 0 && channel < 3; ++channel) {
                            const double change = pictures[shift][now][channel] - pictures[shift - 1][before][channel];
                            squares += change * change;
                            ++count;
                        }
                    }
                }
                worst = smaller(worst, nacre::psnr(squares / count, 1));
            }
            std::printf("%-10s worst of seven steps of one pixel %.1f dB\n", scenes[0].name.c_str(), worst);
            EXPECT_GE(worst, 50) << scenes[0].name;
        }
    }
}

// A slow zoom by 1/64 octave a frame, over four bins of the table: from frame to frame the picture changes steadily.
// The second difference is what a bin's border would show in.
TEST_P(BankBehaviourTest, ZoomingDoesNotPop) {
    constexpr int frames = 33;
    std::vector<std::vector<Float4>> pictures;
    ScatterScene scene = makeScatterScene({.footprint = 16, .width = 160, .height = 96});
    const auto effect = makeEffect(scene);
    double change = 0;
    double jump = 0;
    double count = 0;
    for (int frame = 0; frame < frames; ++frame) {
        ScatterScene now = makeScatterScene({.footprint = 16, .width = 160, .height = 96});
        for (double& depth : now.depth) {
            depth *= std::exp2(-frame / 64.0);
        }
        pictures.push_back(scatter(*effect, now));
        for (std::size_t i = 0; frame >= 2 && i < pictures[0].size(); ++i) {
            for (int channel = 0; channel < 3; ++channel) {
                const double last = pictures[frame][i][channel];
                const double middle = pictures[frame - 1][i][channel];
                const double first = pictures[frame - 2][i][channel];
                change += (last - middle) * (last - middle);
                jump += (last - 2 * middle + first) * (last - 2 * middle + first);
                ++count;
            }
        }
    }
    std::printf("change from frame to frame %.1f dB, of the change %.1f dB\n", nacre::psnr(change / count, 1),
                nacre::psnr(jump / count, 1));
    EXPECT_GE(nacre::psnr(jump / count, 1), 65);
}

// Whole tiles that held a surface and light in the frame before, and hold none now, are as if they never had.
TEST_P(BankBehaviourTest, NothingStaysOfTheFrameBefore) {
    for (const SceneKind kind : tunedSceneKinds) {
        const SceneSettings settings{.kind = kind, .footprint = 60, .width = 200, .height = 136};
        ScatterScene before = makeScatterScene(settings);
        ScatterScene scene = makeScatterScene(settings);
        for (int y = 0; y < scene.height; ++y) {
            for (int x = 0; x < scene.width; ++x) {
                const std::size_t i = scene.index(x, y);
                before.irradiance[i] = {900, 900, 900};
                const bool isEmptyTile = (x / 16 * 5 + y / 16 * 3) % 7 < 3 || x >= 150;
                scene.materialId[i] = isEmptyTile ? 0 : scene.materialId[i];
            }
        }
        const auto effect = makeEffect(scene);
        scatter(*effect, before);
        const std::vector<Float4> after = scatter(*effect, scene);
        const std::vector<Float4> alone = scatter(*makeEffect(scene), scene);
        for (std::size_t i = 0; i < after.size(); ++i) {
            ASSERT_EQ(after[i], alone[i]) << scene.name << ", pixel " << i % scene.width << ", " << i / scene.width;
        }
    }
}

// Not a number, infinite and absurd inputs stay where they are; so does a pixel far from everything.
TEST_P(BankBehaviourTest, ValuesThatAreNotFiniteAreContained) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const ScatterScene scene = makeScatterScene({.footprint = 20, .width = 200, .height = 120});
    const auto effect = makeEffect(scene);
    ScatterInput input = toInput(scene);
    input.irradiance[scene.index(50, 60)] = {nan, 1, 1, 1};
    input.irradiance[scene.index(51, 60)] = {infinity, 1, 1, 1};
    input.irradiance[scene.index(52, 60)] = {1, -infinity, 1, 1};
    input.irradiance[scene.index(53, 60)] = {1, 1, 3e38f, 1};
    input.irradiance[scene.index(30, 20)] = {-1e9f, -3e38f, 1, 1};
    input.irradiance[scene.index(31, 20)] = {6e4f, 6e4f, -6e4f, 1};
    input.depth[scene.index(54, 60)] = nan;
    input.depth[scene.index(55, 60)] = infinity;
    input.depth[scene.index(56, 60)] = 0;
    input.depth[scene.index(57, 60)] = -5;
    for (int i = 0; i < 16; ++i) { // whole texels of the pyramid without light
        input.irradiance[scene.index(120 + i % 4, 60 + i / 4)] = {nan, nan, nan, 1};
    }
    const std::vector<Float4> result = effect->scatter(input, GetParam());
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_TRUE(std::isfinite(result[scene.index(x, y)][channel])) << x << ", " << y;
            }
        }
    }
}

// Light just below the largest half float, between no light and beside light of which sums of two differences are below
// it, is scattered as a ten-thousandth of it is.
TEST_P(BankBehaviourTest, TheBrightestLightIsScatteredAsAnyIs) {
    const ScatterScene scene = makeScatterScene({.footprint = 20, .width = 128, .height = 96});
    for (const VkBool32 shaderFloat16 : {VK_FALSE, gpu.shaderFloat16}) {
        const auto effect = makeEffect(scene, shaderFloat16);
        const auto lit = [&](float bright) {
            ScatterInput input = toInput(scene);
            for (int y = 0; y < scene.height; ++y) {
                for (int x = 0; x < scene.width; ++x) { // rows, columns and blocks of every level
                    const int period = 2 << (x / 16 % 6);
                    const int place = y < 32 ? x : y < 64 ? y : x + y;
                    const float light = place % period < period / 2 ? 0 : x < 70 ? bright : 0.49f * bright;
                    input.irradiance[scene.index(x, y)] = {light, light, light, 1};
                }
            }
            return effect->scatter(input, GetParam());
        };
        const std::vector<Float4> dim = lit(6.5f);
        const std::vector<Float4> bright = lit(65000);
        for (std::size_t i = 0; i < dim.size(); ++i) {
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(bright[i][channel] * 1e-4f, dim[i][channel], 0.02f)
                    << i % scene.width << ", " << i / scene.width;
            }
        }
    }
}

using BankListTest = GpuTest;

// More edge regions than a dispatch has workgroups in a row: where materials are separate, every region of 16x8 px is
// one.
TEST_F(BankListTest, OfListsLongerThanARowEveryRegionIsCombined) {
    constexpr std::uint32_t width = 8192;
    constexpr std::uint32_t height = 1040;
    static_assert(width / 16 * (height / 8) > 65535);
    ScatterInput input = ScatterInput::plane(width, height, Projection::perspective(width, height, width), 100);
    std::vector<NacreLayer> layers[2];
    NacreMaterial materials[] = {toNacre(skin(), layers[0]), toNacre(marble(), layers[1])};
    materials[0].exchangeGroups = 1;
    materials[1].exchangeGroups = 2;
    for (std::size_t i = 0; i < input.materialId.size(); ++i) {
        input.materialId[i] = i % width < width / 2 ? 1 : 2;
        input.irradiance[i] = {0.5f, 0.5f, 0.5f, 1};
    }
    NacreContextInfo info = gpu.contextInfo(input.extent);
    info.techniques = 1u << NACRE_TECHNIQUE_BANK;
    Effect effect(gpu, info);
    ASSERT_EQ(nacreSetMaterials(effect.context, 1, 2, materials), NACRE_SUCCESS);
    const ScatterFormats halves{.irradiance = VK_FORMAT_R16G16B16A16_SFLOAT,
                                .scattered = VK_FORMAT_R16G16B16A16_SFLOAT};
    const std::vector<Float4> result = effect.scatter(input, NACRE_TECHNIQUE_BANK, halves);
    for (std::size_t i = 0; i < result.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            ASSERT_NEAR(result[i][channel], 0.5, 5e-4) << "pixel " << i % width << ", " << i / width;
        }
    }
}

} // namespace
} // namespace nacre::tests
