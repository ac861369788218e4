// The bank algorithm in double precision against the brute-force reference: what its shaders can at best reach.
#include "tests/support/bank_twin.hpp"
#include "tests/support/scatter_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace nacre::tests {
namespace {

constexpr std::array footprints{4.0, 20.0, 60.0};

// Kinds of scene × footprints [px].
void expectCloseness(std::span<const SceneKind> kinds, std::uint32_t seed, const TwinSettings& settings, double least,
                     double leastMean) {
    double sum = 0;
    int cases = 0;
    for (const SceneKind kind : kinds) {
        for (const double footprint : footprints) {
            const ScatterScene scene = makeScatterScene({.kind = kind, .footprint = footprint, .seed = seed});
            const std::vector<ReferencePixel> reference = scatterReference(scene, 7);
            const BankTwin twin(scene, settings);
            const double quality = psnr(scene, reference, twin.result());
            std::printf("seed %u %-10s %.1f dB, largest error %.3f, unfiltered %.1f dB\n", seed, scene.name.c_str(),
                        quality, largestError(scene, reference, twin.result()),
                        psnr(scene, reference, scene.irradiance));
            EXPECT_GE(quality, least) << scene.name << " seed " << seed;
            sum += quality;
            ++cases;
        }
    }
    std::printf("seed %u mean %.2f dB\n", seed, sum / cases);
    EXPECT_GE(sum / cases, leastMean) << "seed " << seed;
}

// Two seeds; the constants were chosen on the first alone.
TEST(BankTwin, IsCloseToTheReference) {
    expectCloseness(tunedSceneKinds, 1, {}, 45, 56);
    expectCloseness(tunedSceneKinds, 7, {}, 44, 54);
}

// The first seed is bank_quality_test's.
TEST(BankTwin, IsCloserWithSecondSurfaces) {
    expectCloseness(tunedSceneKinds, 7, {.secondSurfaces = true}, 46, 54.5);
}

// The hardest are strands as thin as the finest texels, and floors near the horizon.
TEST(BankTwin, IsCloseOnScenesThatItWasNotTunedOn) {
    expectCloseness(heldOutSceneKinds, 3, {}, 36, 50);
    expectCloseness(heldOutSceneKinds, 3, {.secondSurfaces = true}, 37, 51);
}

// A level's texels end where the picture does, here at the pyramid's border on all sides: light that is cut off there
// must not weigh more on coarse levels than on fine ones.
TEST(BankTwin, IsAsCloseAtTheBorder) {
    constexpr int border = 4;
    constexpr int inner = 24;
    std::array<double, 2> squares{}; // within `border` px; further than `inner`
    std::array<int, 2> counts{};
    for (const std::uint32_t seed : {1u, 7u}) {
        const ScatterScene scene = makeScatterScene({.footprint = 60, .width = 320, .height = 192, .seed = seed});
        const BankTwin twin(scene);
        for (const ReferencePixel& pixel : scatterReference(scene, 3)) {
            const int distance = std::min({pixel.x, pixel.y, scene.width - 1 - pixel.x, scene.height - 1 - pixel.y});
            if (distance >= border && distance < inner) {
                continue;
            }
            const Rgb& result = twin.result()[scene.index(pixel.x, pixel.y)];
            for (int channel = 0; channel < 3; ++channel) {
                squares[distance < border ? 0 : 1] += std::pow(result[channel] - pixel.value[channel], 2);
            }
            ++counts[distance < border ? 0 : 1];
        }
    }
    const double atBorder = std::sqrt(squares[0] / (3 * counts[0]));
    const double inside = std::sqrt(squares[1] / (3 * counts[1]));
    std::printf("error within %d px of the border %.5f, further inside %.5f\n", border, atBorder, inside);
    EXPECT_LE(atBorder, 1.5 * inside);
}

void expectBeforeTheCamera(std::span<const SceneKind> kinds) {
    for (const SceneKind kind : kinds) {
        for (std::uint32_t seed = 1; seed <= 16; ++seed) {
            const ScatterScene scene = makeScatterScene({.kind = kind, .width = 160, .height = 90, .seed = seed});
            for (std::size_t i = 0; i < scene.depth.size(); ++i) {
                ASSERT_TRUE(scene.materialId[i] == 0 || scene.depth[i] > 0) << scene.name << ", seed " << seed;
            }
        }
    }
}

TEST(ScatterScenes, LieBeforeTheCamera) {
    expectBeforeTheCamera(tunedSceneKinds);
    expectBeforeTheCamera(heldOutSceneKinds);
}

// What does not scatter never enters, however bright.
TEST(BankTwin, KeepsAConstantFieldConstant) {
    for (const SceneKind kind : tunedSceneKinds) {
        ScatterScene scene = makeScatterScene({.kind = kind, .footprint = 20, .width = 160, .height = 96});
        for (std::size_t i = 0; i < scene.irradiance.size(); ++i) {
            scene.irradiance[i] = scene.materialId[i] != 0 ? Rgb{0.5, 0.5, 0.5} : Rgb{1e6, 1e6, 1e6};
        }
        const BankTwin twin(scene);
        for (std::size_t i = 0; i < scene.irradiance.size(); ++i) {
            if (scene.materialId[i] != 0) {
                ASSERT_NEAR(twin.result()[i][0], 0.5, 1e-9) << scene.name << " pixel " << i;
            }
        }
    }
}

} // namespace
} // namespace nacre::tests
