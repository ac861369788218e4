// Techniques `bank` and `bank-surfaces` on hard synthetic scenes: against their CPU twin, which they must equal but for
// half floats, and against the brute-force sum in double precision.
#include "tests/gpu/support/scene_input.hpp"
#include "tests/support/bank_twin.hpp"
#include "tests/support/scatter_reference.hpp"

#include <cmath>
#include <cstdio>

namespace nacre::tests {
namespace {

class BankQualityTest : public GpuTest {
protected:
    void expectQuality(NacreTechnique technique, const TwinSettings& settings, double least, double leastMean);
};

double psnrOfTwin(const ScatterScene& scene, std::span<const Rgb> image, std::span<const Rgb> twin) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        for (int channel = 0; scene.materialId[i] != 0 && channel < 3; ++channel) {
            sum += (image[i][channel] - twin[i][channel]) * (image[i][channel] - twin[i][channel]);
            ++count;
        }
    }
    return -10 * std::log10(sum / static_cast<double>(count) + 1e-12);
}

// The reference has every seventh pixel.
void BankQualityTest::expectQuality(NacreTechnique technique, const TwinSettings& settings, double least,
                                    double leastMean) {
    double sum = 0;
    int cases = 0;
    for (const SceneKind kind : allSceneKinds) {
        for (const double footprint : {4.0, 20.0, 60.0}) {
            const ScatterScene scene = makeScatterScene({.kind = kind, .footprint = footprint});
            const ScatterInput input = toInput(scene);
            NacreContextInfo info = gpu.contextInfo(input.extent);
            info.techniques = 1u << technique;
            Effect effect(gpu, info);
            effect.setMaterials(scene.materials);
            const std::vector<Rgb> image = toRgb(effect.scatter(input, technique));
            const BankTwin twin(scene, settings);
            const std::vector<ReferencePixel> reference = scatterReference(scene, 7);
            const double quality = psnr(scene, reference, image);
            const double likeness = psnrOfTwin(scene, image, twin.result());
            std::printf("%-10s against reference %.1f dB (twin %.1f), largest error %.3f, against twin %.1f dB\n",
                        scene.name.c_str(), quality, psnr(scene, reference, twin.result()),
                        largestError(scene, reference, image), likeness);
            EXPECT_GE(quality, least) << scene.name;
            EXPECT_GE(likeness, 60) << scene.name;
            sum += quality;
            ++cases;
        }
    }
    std::printf("mean %.2f dB\n", sum / cases);
    EXPECT_GE(sum / cases, leastMean);
}

TEST_F(BankQualityTest, OneSurface) {
    expectQuality(NACRE_TECHNIQUE_BANK, {}, 37, 50);
}

TEST_F(BankQualityTest, TwoSurfaces) {
    expectQuality(NACRE_TECHNIQUE_BANK_SURFACES, {.secondSurfaces = true}, 45, 55);
}

} // namespace
} // namespace nacre::tests
