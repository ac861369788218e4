// Techniques `bank` and `bank-surfaces` on hard synthetic scenes: against their CPU twin, which they must equal but for
// half floats, and against the brute-force sum in double precision.
#include "image/metrics.hpp"
#include "tests/gpu/support/scene_input.hpp"
#include "tests/support/bank_twin.hpp"
#include "tests/support/scatter_reference.hpp"

#include <cmath>
#include <cstdio>

namespace nacre::tests {
namespace {

class BankQualityTest : public GpuTest {};

double psnrOfTwin(const ScatterScene& scene, std::span<const Rgb> image, std::span<const Rgb> twin) {
    ErrorSums sums;
    for (std::size_t i = 0; i < image.size(); ++i) {
        for (int channel = 0; scene.materialId[i] != 0 && channel < 3; ++channel) {
            sums.add(image[i][channel], twin[i][channel]);
        }
    }
    return sums.psnr(1);
}

struct Case {
    const char* name;
    NacreTechnique technique;
    VkBool32 shaderFloat16;
    bool secondSurfaces;
    double least, leastMean; // dB
    double sum = 0;
};

// The reference has every seventh pixel.
TEST_F(BankQualityTest, TwelveScenes) {
    std::vector<Case> cases{{"bank", NACRE_TECHNIQUE_BANK, VK_FALSE, false, 44, 55},
                            {"bank-surfaces", NACRE_TECHNIQUE_BANK_SURFACES, VK_FALSE, true, 50, 57}};
    if (gpu.shaderFloat16) {
        cases.push_back({"bank, half floats", NACRE_TECHNIQUE_BANK, VK_TRUE, false, 44, 55});
    } else {
        std::printf("The device has no half floats: they are not tested.\n");
    }
    int scenes = 0;
    for (const SceneKind kind : tunedSceneKinds) {
        for (const double footprint : {4.0, 20.0, 60.0}) {
            const ScatterScene scene = makeScatterScene({.kind = kind, .footprint = footprint});
            const std::vector<ReferencePixel> reference = scatterReference(scene, 7);
            const ScatterInput input = toInput(scene);
            const BankTwin oneTwin(scene, {});
            const BankTwin surfacesTwin(scene, {.secondSurfaces = true});
            for (Case& c : cases) {
                NacreContextInfo info = gpu.contextInfo(input.extent);
                info.techniques = 1u << c.technique;
                info.shaderFloat16 = c.shaderFloat16;
                Effect effect(gpu, info);
                effect.setMaterials(scene.materials);
                const std::vector<Rgb> image = toRgb(effect.scatter(input, c.technique));
                const BankTwin& twin = c.secondSurfaces ? surfacesTwin : oneTwin;
                const double quality = psnr(scene, reference, image);
                const double likeness = psnrOfTwin(scene, image, twin.result());
                std::printf(
                    "%-17s %-10s against reference %.1f dB (twin %.1f), largest error %.3f, against twin %.1f dB\n",
                    c.name, scene.name.c_str(), quality, psnr(scene, reference, twin.result()),
                    largestError(scene, reference, image), likeness);
                EXPECT_GE(quality, c.least) << scene.name;
                EXPECT_GE(likeness, 80) << scene.name;
                c.sum += quality;
            }
            ++scenes;
        }
    }
    for (const Case& c : cases) {
        std::printf("%s: mean %.2f dB\n", c.name, c.sum / scenes);
        EXPECT_GE(c.sum / scenes, c.leastMean);
    }
}

// Sizes that no tile, region or block divides; scenes that nothing was tuned on.
TEST_F(BankQualityTest, EqualsItsTwinAtOddSizes) {
    const std::pair<int, int> sizes[] = {{333, 187}, {97, 211}};
    for (const SceneKind kind : heldOutSceneKinds) {
        for (const auto& [width, height] : sizes) {
            const ScatterScene scene = makeScatterScene({.kind = kind, .width = width, .height = height, .seed = 5});
            const ScatterInput input = toInput(scene);
            for (const bool secondSurfaces : {false, true}) {
                const NacreTechnique technique = secondSurfaces ? NACRE_TECHNIQUE_BANK_SURFACES : NACRE_TECHNIQUE_BANK;
                NacreContextInfo info = gpu.contextInfo(input.extent);
                info.techniques = 1u << technique;
                Effect effect(gpu, info);
                effect.setMaterials(scene.materials);
                const std::vector<Rgb> image = toRgb(effect.scatter(input, technique));
                const BankTwin twin(scene, {.secondSurfaces = secondSurfaces});
                const double likeness = psnrOfTwin(scene, image, twin.result());
                std::printf("%-13s %-10s %dx%d, against twin %.1f dB\n", nacreTechniqueString(technique),
                            scene.name.c_str(), width, height, likeness);
                EXPECT_GE(likeness, 74) << scene.name;
            }
        }
    }
}

} // namespace
} // namespace nacre::tests
