// Technique `burley` against `brute` on hard synthetic scenes, and what its samples must keep.
#include "tests/gpu/support/scene_input.hpp"

#include <cstdio>
#include <limits>
#include <stdexcept>

namespace nacre::tests {
namespace {

constexpr VkExtent2D extent{192, 108};

class BurleyTest : public GpuTest {
protected:
    Effect& effect() {
        static const auto shared = [this] {
            NacreContextInfo info = gpu.contextInfo(extent);
            info.techniques = 1u << NACRE_TECHNIQUE_BURLEY | 1u << NACRE_TECHNIQUE_BRUTE;
            return std::make_unique<Effect>(gpu, info);
        }();
        return *shared;
    }
    std::vector<Float4> scatter(const ScatterInput& input, std::uint32_t budget, std::uint32_t rotation = 0) {
        return effect().scatter(input, [&](NacreScatterInfo& info) {
            info.technique = NACRE_TECHNIQUE_BURLEY;
            info.burleySampleBudget = budget;
            info.burleyRotation = rotation;
        });
    }
};

ScatterScene makeScene(SceneKind kind, double footprint) {
    return makeScatterScene({.kind = kind, .footprint = footprint, .width = extent.width, .height = extent.height});
}

TEST_F(BurleyTest, AgainstBruteAndBetterWithSamples) {
    for (const SceneKind kind : tunedSceneKinds) {
        for (const double footprint : {4.0, 10.0, 20.0}) {
            const ScatterScene scene = makeScene(kind, footprint);
            effect().setMaterials(scene.materials);
            for (const bool normals : {false, true}) {
                const ScatterInput input = toInput(scene, normals);
                const std::vector<Float4> brute = effect().scatter(input, NACRE_TECHNIQUE_BRUTE);
                const double few = psnr(scatter(input, 16), brute, input.materialId);
                const double usual = psnr(scatter(input, 64), brute, input.materialId);
                std::printf("%-10s, %s normals: %.1f dB with 16 samples, %.1f with 64\n", scene.name.c_str(),
                            normals ? "with" : "without", few, usual);
                EXPECT_GE(usual, 44) << scene.name;
                // A smaller disc has fewer samples than the budget allows.
                EXPECT_GE(usual, few + (footprint == 20 ? 2 : 0)) << scene.name;
            }
        }
    }
}

TEST_F(BurleyTest, AreaWeightsAndTheLargestBudgetHelpOnSlopes) {
    const ScatterScene scene = makeScene(SceneKind::Tilt, 20);
    effect().setMaterials(scene.materials);
    double quality[2][2];
    for (const bool normals : {false, true}) {
        const ScatterInput input = toInput(scene, normals);
        const std::vector<Float4> brute = effect().scatter(input, NACRE_TECHNIQUE_BRUTE);
        quality[normals][0] = psnr(scatter(input, 0), brute, input.materialId);
        quality[normals][1] = psnr(scatter(input, 256), brute, input.materialId);
    }
    EXPECT_GE(quality[true][0], quality[false][0] + 2);
    EXPECT_GE(quality[true][1], quality[false][1] + 4);
    EXPECT_GE(quality[true][1], quality[true][0] + 1);
}

TEST_F(BurleyTest, RotationsAreRepeatableAndAverageOut) {
    const ScatterScene scene = makeScene(SceneKind::Plane, 20);
    effect().setMaterials(scene.materials);
    const ScatterInput input = toInput(scene);
    const std::vector<Float4> first = scatter(input, 16);
    EXPECT_EQ(scatter(input, 16), first);
    EXPECT_EQ(scatter(input, 16, 64), first);
    EXPECT_NE(scatter(input, 16, 1), first);
    constexpr std::uint32_t frames = 8;
    std::vector<Float4> mean(first.size());
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        const std::vector<Float4> image = scatter(input, 16, frame);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            for (int channel = 0; channel < 3; ++channel) {
                mean[i][channel] += image[i][channel] / frames;
            }
        }
    }
    const std::vector<Float4> brute = effect().scatter(input, NACRE_TECHNIQUE_BRUTE);
    EXPECT_GE(psnr(mean, brute, input.materialId), psnr(first, brute, input.materialId) + 5);
}

TEST_F(BurleyTest, LessThanAPixelIsCopied) {
    const ScatterScene scene = makeScene(SceneKind::Plane, 0.5);
    effect().setMaterials(scene.materials);
    const ScatterInput input = toInput(scene);
    EXPECT_EQ(psnr(scatter(input, 64), input.irradiance, input.materialId), std::numeric_limits<double>::infinity());
}

TEST_F(BurleyTest, RefusesMoreSamplesThanTheBudgetMayBe) {
    const ScatterScene scene = makeScene(SceneKind::Plane, 4);
    effect().setMaterials(scene.materials);
    EXPECT_THROW(scatter(toInput(scene), 257), std::runtime_error);
    EXPECT_EQ(effect().messages.back(), "NacreScatterInfo::burleySampleBudget is 257, must be in [1, 256]");
}

} // namespace
} // namespace nacre::tests
