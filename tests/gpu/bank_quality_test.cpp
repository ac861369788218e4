// Techniques `bank` and `bank-surfaces` on hard synthetic scenes: against their CPU twin, which they must equal but for
// half floats, and against the brute-force sum in double precision.
#include "tests/gpu/support/scene_input.hpp"
#include "tests/support/bank_twin.hpp"
#include "tests/support/scatter_reference.hpp"

#include <cmath>
#include <cstdio>

namespace nacre::tests {
namespace {

class BankQualityTest : public GpuTest {};

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

struct Case {
    NacreTechnique technique;
    TwinSettings settings;
    double least, leastMean; // dB
    double sum = 0;
};

// The reference has every seventh pixel.
TEST_F(BankQualityTest, TwelveScenes) {
    Case cases[] = {{NACRE_TECHNIQUE_BANK, {}, 37, 50},
                    {NACRE_TECHNIQUE_BANK_SURFACES, {.secondSurfaces = true}, 45, 55}};
    int scenes = 0;
    for (const SceneKind kind : allSceneKinds) {
        for (const double footprint : {4.0, 20.0, 60.0}) {
            const ScatterScene scene = makeScatterScene({.kind = kind, .footprint = footprint});
            const std::vector<ReferencePixel> reference = scatterReference(scene, 7);
            const ScatterInput input = toInput(scene);
            NacreContextInfo info = gpu.contextInfo(input.extent);
            info.techniques = 1u << NACRE_TECHNIQUE_BANK | 1u << NACRE_TECHNIQUE_BANK_SURFACES;
            Effect effect(gpu, info);
            effect.setMaterials(scene.materials);
            for (Case& c : cases) {
                const std::vector<Rgb> image = toRgb(effect.scatter(input, c.technique));
                const BankTwin twin(scene, c.settings);
                const double quality = psnr(scene, reference, image);
                const double likeness = psnrOfTwin(scene, image, twin.result());
                std::printf(
                    "%-13s %-10s against reference %.1f dB (twin %.1f), largest error %.3f, against twin %.1f dB\n",
                    nacreTechniqueString(c.technique), scene.name.c_str(), quality,
                    psnr(scene, reference, twin.result()), largestError(scene, reference, image), likeness);
                EXPECT_GE(quality, c.least) << scene.name;
                EXPECT_GE(likeness, 60) << scene.name;
                c.sum += quality;
            }
            ++scenes;
        }
    }
    for (const Case& c : cases) {
        std::printf("%s: mean %.2f dB\n", nacreTechniqueString(c.technique), c.sum / scenes);
        EXPECT_GE(c.sum / scenes, c.leastMean);
    }
}

} // namespace
} // namespace nacre::tests
