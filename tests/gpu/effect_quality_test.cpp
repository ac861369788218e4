// The scatter techniques on hard synthetic scenes: `brute` against the same sum in double precision on the CPU, and
// `separable` against `brute`.
#include "tests/gpu/support/effect.hpp"
#include "tests/support/scatter_reference.hpp"

#include <cmath>

using namespace nacre;
using namespace nacre::tests;

namespace {

// dB: what `brute` is to have against the same sum in double precision.
constexpr double leastOfBrute = 75;

ScatterInput toInput(const ScatterScene& scene) {
    ScatterInput input;
    input.extent = {static_cast<std::uint32_t>(scene.width), static_cast<std::uint32_t>(scene.height)};
    input.view = makeView(Projection::perspective(scene.width, scene.height, scene.focalLength));
    for (std::size_t i = 0; i < scene.depth.size(); ++i) {
        const Rgb& light = scene.irradiance[i];
        const Rgb& normal = scene.normal[i];
        input.irradiance.push_back(
            {static_cast<float>(light[0]), static_cast<float>(light[1]), static_cast<float>(light[2]), 1});
        input.depth.push_back(static_cast<float>(scene.depth[i]));
        input.materialId.push_back(scene.materialId[i]);
        // The scene's axes are the image's: y down, z away.
        input.normal.push_back(
            {static_cast<float>(normal[0]), static_cast<float>(-normal[1]), static_cast<float>(-normal[2]), 0});
    }
    return input;
}

class QualityTest : public GpuTest, public testing::WithParamInterface<std::tuple<SceneKind, double>> {
protected:
    SceneSettings settings() const {
        return {.kind = std::get<0>(GetParam()), .footprint = std::get<1>(GetParam()), .width = 192, .height = 108};
    }
    Effect& shared() {
        static const auto effect = [this] {
            NacreContextInfo info = gpu.contextInfo({192, 108});
            info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE | 1u << NACRE_TECHNIQUE_BRUTE;
            return std::make_unique<Effect>(gpu, info);
        }();
        return *effect;
    }
};

TEST_P(QualityTest, BruteAgainstDoublePrecisionAndSeparableAgainstBrute) {
    const ScatterScene scene = makeScatterScene(settings());
    const ScatterInput input = toInput(scene);
    Effect& effect = shared();
    effect.setMaterials(scene.materials);
    const std::vector<Float4> brute = effect.scatter(input, NACRE_TECHNIQUE_BRUTE);
    std::vector<Rgb> image;
    for (const Float4& pixel : brute) {
        image.push_back({pixel[0], pixel[1], pixel[2]});
    }
    const double bruteQuality = psnr(scene, scatterReference(scene, 7, asBrute), image);
    const double separableQuality = psnr(effect.scatter(input, NACRE_TECHNIQUE_SEPARABLE), brute, input.materialId);
    std::cout << scene.name << ": brute against double precision " << bruteQuality << " dB, separable against brute "
              << separableQuality << " dB\n";
    EXPECT_GE(bruteQuality, leastOfBrute);
    EXPECT_GE(separableQuality, 38);
}

// A receiver whose window is the whole picture, more pixels than the loops of a software device may turn (65,535). Few
// pixels have a material, so that the sum stays quick.
TEST_F(GpuTest, BruteSumsWindowsOfMorePixelsThanALoopMayTurn) {
    constexpr int every = 16;
    ScatterScene scene = makeScatterScene(
        {.kind = SceneKind::Plane, .footprint = 500, .width = 400, .height = 240, .materials = {marble()}});
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            std::uint8_t& id = scene.materialId[scene.index(x, y)];
            id = x % every == y / every % every && y % every == 0 ? id : 0;
            // Light that differs from top to bottom: a sum that lacks rows is another.
            const double light = y < scene.height / 2 ? 0.2 : 1.0;
            scene.irradiance[scene.index(x, y)] = {light, light, light};
        }
    }
    NacreContextInfo info =
        gpu.contextInfo({static_cast<std::uint32_t>(scene.width), static_cast<std::uint32_t>(scene.height)});
    info.techniques = 1u << NACRE_TECHNIQUE_BRUTE;
    Effect effect(gpu, info);
    effect.setMaterials(scene.materials);
    const ScatterInput input = toInput(scene);
    NacreCost cost{};
    ASSERT_EQ(nacreGetScatterCost(effect.context, NACRE_TECHNIQUE_BRUTE, &cost), NACRE_SUCCESS);
    EXPECT_EQ(cost.passCount, 2u);
    EXPECT_EQ(cost.dispatchCount, 1u + 3u) << "96,000 pixels in bands of 32,768";
    std::vector<Rgb> image;
    for (const Float4& pixel : effect.scatter(input, NACRE_TECHNIQUE_BRUTE)) {
        image.push_back({pixel[0], pixel[1], pixel[2]});
    }
    const std::vector<ReferencePixel> reference = scatterReference(scene, 1, asBrute);
    const double quality = psnr(scene, reference, image);
    std::cout << reference.size() << " receivers: brute against double precision " << quality << " dB\n";
    EXPECT_GE(reference.size(), 300u);
    EXPECT_GE(quality, leastOfBrute);
}

INSTANTIATE_TEST_SUITE_P(Scenes, QualityTest,
                         testing::Combine(testing::ValuesIn(tunedSceneKinds), testing::Values(4.0, 20.0, 60.0)));

} // namespace
