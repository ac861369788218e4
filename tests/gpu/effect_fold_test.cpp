// Tier 0: closed forms for `brute` where the surface is not a plane. Two half planes that meet in a fold, one of them
// lit; and normals that the depth does not bear out.
#include "tests/gpu/support/effect.hpp"
#include "tests/support/worst.hpp"

#include <cmath>

using namespace nacre;
using namespace nacre::tests;

namespace {

/// Left of the middle a plane that faces the camera, right of it one that falls away by `slope`, lit. One row is
/// worked out.
struct FoldScene {
    FoldScene(const Material& material, double footprint, double slope)
        : radius(makeProfile(material)->quantileRadius(0.997)), pixel(radius / footprint) {
        reach = static_cast<int>(std::ceil(1.4 * footprint)) + 6;
        const auto size = static_cast<std::uint32_t>(2 * reach);
        input = ScatterInput::plane(size, size, Projection::orthographic(size, size, 1 / pixel), 500);
        const auto length = static_cast<float>(std::sqrt(1 + slope * slope));
        input.normal.assign(input.depth.size(), {0, 0, 1, 0});
        input.irradiance.assign(input.depth.size(), {0, 0, 0, 1});
        for (std::uint32_t y = 0; y < size; ++y) {
            for (int x = reach; x < 2 * reach; ++x) {
                const std::size_t i = input.index(x, y);
                input.depth[i] += static_cast<float>(slope * (x - reach + 0.5) * pixel);
                input.normal[i] = {static_cast<float>(slope) / length, 0, 1 / length, 0};
                input.irradiance[i] = {1, 1, 1, 1};
            }
        }
        input.strength.assign(input.depth.size(), 0);
        std::fill_n(input.strength.begin() + input.index(0, size / 2), size, 1.0f);
    }

    double radius; // mm
    double pixel;  // mm
    int reach;     // px, from the fold to either side
    ScatterInput input;
};

/// Light at the distance `a` from the fold, on the unlit half plane. A Gaussian's share of its own half plane is
/// Φ(a / σ); that of the other, at the angle φ to it, is exp(−a²·sin²φ / 2σ²)·Φ(a·cosφ / σ), Φ the normal
/// distribution's integral: the sum over the fold's direction, then over b in a² + b² − 2·a·b·cosφ.
double foldLight(const Material& material, int channel, double a, double cosine) {
    double other = 0;
    double own = 0;
    for (const Layer& layer : makeLayers(material)) {
        const double scale = 1 / std::sqrt(2 * layer.variance);
        const double across = a * a * (1 - cosine * cosine) * scale * scale;
        other += layer.weight[channel] * std::exp(-across) * 0.5 * std::erfc(-a * cosine * scale);
        own += layer.weight[channel] * 0.5 * std::erfc(-a * scale);
    }
    return other / (other + own);
}

class FoldTest : public GpuTest, public testing::WithParamInterface<std::tuple<double, double>> {
protected:
    std::vector<Float4> brute(const Material& material, const ScatterInput& input) {
        NacreContextInfo info = gpu.contextInfo(input.extent);
        info.techniques = 1u << NACRE_TECHNIQUE_BRUTE;
        Effect effect(gpu, info);
        effect.setMaterials({&material, 1});
        return effect.scatter(input, NACRE_TECHNIQUE_BRUTE);
    }

    void check(const Material& material) {
        const auto [footprint, slope] = GetParam();
        const FoldScene scene(material, footprint, slope);
        const std::vector<Float4> result = brute(material, scene.input);
        const double steepness = std::sqrt(1 + slope * slope);
        double worst = 0;
        const int count = static_cast<int>(footprint) + 2;
        for (int x = -count; x < count; ++x) {
            const Float4& pixel = result[scene.input.index(scene.reach + x, scene.input.extent.height / 2)];
            const double a = std::abs(x + 0.5) * scene.pixel * (x < 0 ? 1 : steepness);
            for (int channel = 0; channel < 3; ++channel) {
                const double unlit = foldLight(material, channel, a, -1 / steepness);
                const double expected = x < 0 ? unlit : 1 - unlit;
                worst = larger(worst, std::abs(pixel[channel] - expected));
                EXPECT_NEAR(pixel[channel], expected, 0.003)
                    << material.name << ", " << x << " px from the fold, channel " << channel;
            }
        }
        std::printf("%s: largest error %.4f\n", material.name.c_str(), worst);
    }
};

TEST_P(FoldTest, Skin) {
    check(skin());
}
TEST_P(FoldTest, Marble) {
    check(marble());
}

INSTANTIATE_TEST_SUITE_P(Folds, FoldTest,
                         testing::Combine(testing::Values(2.0, 6.0, 20.0), testing::Values(-1.8, 0.7, 1.8)));

class RimTest : public GpuTest {};

/// A column of normals across the ray, as a silhouette has them, on a flat strip changes nothing.
TEST_F(RimTest, NormalsThatDepthDoesNotBearOut) {
    const Material material = marble();
    FoldScene scene(material, 6, 0);
    NacreContextInfo info = gpu.contextInfo(scene.input.extent);
    info.techniques = 1u << NACRE_TECHNIQUE_BRUTE;
    Effect effect(gpu, info);
    effect.setMaterials({&material, 1});
    const std::vector<Float4> flat = effect.scatter(scene.input, NACRE_TECHNIQUE_BRUTE);
    for (std::uint32_t y = 0; y < scene.input.extent.height; ++y) {
        scene.input.normal[scene.input.index(scene.reach, y)] = {1, 0, 1e-3f, 0};
    }
    const std::vector<Float4> turned = effect.scatter(scene.input, NACRE_TECHNIQUE_BRUTE);
    for (std::size_t i = 0; i < flat.size(); ++i) {
        EXPECT_NEAR(turned[i][0], flat[i][0], 1e-3) << "column " << i % scene.input.extent.width;
    }
}

} // namespace
