// The resolve of docs/integration-raster.md: images of four samples a pixel, resolved by id, give the light that a
// picture of four times as many pixels a side has at these samples; no halo at silhouettes, and a constant field stays
// constant.
#include "tests/gpu/support/effect.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr std::uint32_t side = 40; // px
constexpr std::uint32_t fine = 4;  // pixels of the supersampled picture, a side of a pixel
constexpr double focalLength = 60;

/// What a point of the picture shows, in pixels: a disc of material 1 before a wall of material 2 on its left, and
/// nothing with subsurface scattering on the right.
struct Seen {
    std::uint16_t id;
    float depth;
    float light;
};

Seen seenAt(double x, double y, bool isConstant) {
    const bool isDisc = std::hypot(x - 20.3, y - 19.6) < 11.37;
    const float stripes = static_cast<int>(std::floor((x + 0.5 * y) / 5)) % 2 == 0 ? 1.0f : 0.2f;
    const std::uint16_t id = isDisc ? 1 : x < 20 ? 2 : 0;
    return {id, isDisc ? 60.0f : 90.0f, isConstant ? 1.0f : isDisc ? stripes : 0.1f};
}

/// Vulkan's standard places of four samples.
constexpr double places[4][2] = {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};

/// A pixel's samples as one: those of the id of the sample that is nearest to the camera.
struct Resolved {
    Seen seen;
    double share;  ///< of the samples that it stands for
    double others; ///< light of the others, over all samples
};

Resolved resolve(std::uint32_t px, std::uint32_t py, bool isConstant) {
    Seen samples[4];
    for (int i = 0; i < 4; ++i) {
        samples[i] = seenAt(px + places[i][0], py + places[i][1], isConstant);
    }
    Resolved result{
        *std::min_element(samples, samples + 4, [](const Seen& a, const Seen& b) { return a.depth < b.depth; }), 0, 0};
    double light = 0;
    for (const Seen& sample : samples) {
        const bool isSame = sample.id == result.seen.id;
        light += isSame ? sample.light : 0;
        result.share += isSame ? 0.25 : 0;
        result.others += isSame ? 0 : 0.25 * sample.light;
    }
    result.seen.light = static_cast<float>(0.25 * light / result.share);
    return result;
}

class MsaaTest : public GpuTest {
protected:
    MsaaTest() {
        NacreContextInfo info = gpu.contextInfo({side * fine, side * fine});
        info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        effect_ = std::make_unique<Effect>(gpu, info);
        const Material materials[] = {marble(), skin()};
        effect_->setMaterials(materials);
    }
    static void set(ScatterInput& input, std::size_t index, const Seen& seen) {
        input.irradiance[index] = {seen.light, seen.light, seen.light, 1};
        input.depth[index] = seen.depth;
        input.materialId[index] = seen.id;
    }
    /// Of a picture with fine² pixels a pixel, each of one surface, the mean of the four that lie where the samples
    /// lie: what an effect that scattered every sample by itself would give.
    std::vector<double> supersampled(bool isConstant) {
        constexpr std::uint32_t size = side * fine;
        ScatterInput input =
            ScatterInput::plane(size, size, Projection::perspective(size, size, focalLength * fine), 1);
        for (std::uint32_t i = 0; i < size * size; ++i) {
            set(input, i, seenAt((i % size + 0.5) / fine, (i / size + 0.5) / fine, isConstant));
        }
        const std::vector<Float4> picture = effect_->scatter(input, NACRE_TECHNIQUE_SEPARABLE);
        std::vector<double> mean(side * side);
        for (std::uint32_t i = 0; i < side * side; ++i) {
            for (const auto& place : places) {
                const auto x = static_cast<std::uint32_t>((i % side + place[0]) * fine);
                const auto y = static_cast<std::uint32_t>((i / side + place[1]) * fine);
                mean[i] += 0.25 * picture[y * size + x][0];
            }
        }
        return mean;
    }
    /// Four samples resolved by id, or averaged; then scattered, and put back by the share of the id's samples.
    std::vector<double> multisampled(bool isConstant, bool byId) {
        ScatterInput input = ScatterInput::plane(side, side, Projection::perspective(side, side, focalLength), 1);
        std::vector<Resolved> resolved;
        for (std::uint32_t i = 0; i < side * side; ++i) {
            resolved.push_back(resolve(i % side, i / side, isConstant));
            Seen seen = resolved.back().seen;
            if (!byId) { // what vkCmdResolveImage would make of light and depth
                seen.light = 0;
                seen.depth = 0;
                for (const auto& place : places) {
                    const Seen sample = seenAt(i % side + place[0], i / side + place[1], isConstant);
                    seen.light += 0.25f * sample.light;
                    seen.depth += 0.25f * sample.depth;
                }
            }
            set(input, i, seen);
        }
        const std::vector<Float4> picture = effect_->scatter(input, NACRE_TECHNIQUE_SEPARABLE);
        std::vector<double> light;
        for (std::uint32_t i = 0; i < side * side; ++i) {
            light.push_back(byId ? resolved[i].share * picture[i][0] + resolved[i].others : picture[i][0]);
        }
        return light;
    }
    /// The largest error at the disc's border, and the mean.
    static std::pair<double, double> errors(const std::vector<double>& picture, const std::vector<double>& truth) {
        double most = 0, sum = 0;
        int count = 0;
        for (std::uint32_t i = 0; i < side * side; ++i) {
            if (std::abs(std::hypot(i % side + 0.5 - 20.3, i / side + 0.5 - 19.6) - 11.37) < 2) {
                const double error = std::abs(picture[i] - truth[i]);
                most = std::max(most, error);
                sum += error;
                ++count;
            }
        }
        return {most, sum / count};
    }

    std::unique_ptr<Effect> effect_;
};

TEST_F(MsaaTest, ConstantFieldStaysConstant) {
    for (const double light : multisampled(true, true)) {
        ASSERT_NEAR(light, 1, 1e-3);
    }
}

TEST_F(MsaaTest, SilhouettesHaveNoHalo) {
    const std::vector<double> truth = supersampled(false);
    const auto [most, mean] = errors(multisampled(false, true), truth);
    const auto [mostAveraged, meanAveraged] = errors(multisampled(false, false), truth);
    std::printf("error at the silhouette: by id %.4f, at most %.4f; averaged %.4f, at most %.4f\n", mean, most,
                meanAveraged, mostAveraged);
    EXPECT_LT(mean, 0.012);
    EXPECT_LT(most, 0.1);
    EXPECT_LT(mean, 0.7 * meanAveraged) << "averaged depth and light are worse";
}

} // namespace
