// Tier 0: closed forms. A shadow edge on a plane that faces the camera, and light that is the same everywhere.
#include "tests/gpu/support/effect.hpp"
#include "tests/support/worst.hpp"

#include <cmath>

using namespace nacre;
using namespace nacre::tests;

namespace {

/// A plane whose material's 99.7 % radius is `footprint` px, lit right of the middle column's left edge.
ScatterInput edgeScene(const Material& material, double footprint, double& millimetresPerPixel) {
    const double radius = makeProfile(material)->quantileRadius(0.997);
    const auto reach = static_cast<std::uint32_t>(std::ceil(1.4 * footprint)) + 6;
    const std::uint32_t size = 2 * reach;
    millimetresPerPixel = radius / footprint;
    const float depth = 500;
    ScatterInput input =
        ScatterInput::plane(size, size, Projection::perspective(size, size, depth / millimetresPerPixel), depth);
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const float light = x >= reach ? 1.0f : 0.0f;
            input.irradiance[input.index(x, y)] = {light, light, light, 1};
        }
    }
    // Only the row that is looked at is worked out.
    input.strength.assign(input.depth.size(), 0);
    std::fill_n(input.strength.begin() + input.index(0, size / 2), size, 1.0f);
    return input;
}

class EdgeTest : public GpuTest, public testing::WithParamInterface<double> {
protected:
    void checkBrute(const Material& material) {
        double millimetresPerPixel = 0;
        const ScatterInput input = edgeScene(material, GetParam(), millimetresPerPixel);
        NacreContextInfo info = gpu.contextInfo(input.extent);
        info.techniques = 1u << NACRE_TECHNIQUE_BRUTE;
        Effect effect(gpu, info);
        effect.setMaterials({&material, 1});
        const std::vector<Float4> result = effect.scatter(input, NACRE_TECHNIQUE_BRUTE);
        const auto profile = makeProfile(material);
        const std::uint32_t middle = input.extent.width / 2;
        const int reach = static_cast<int>(1.2 * GetParam()) + 2;
        double worst = 0;
        for (int dx = -reach; dx < reach; ++dx) {
            const Float4& pixel = result[input.index(middle + dx, input.extent.height / 2)];
            for (int channel = 0; channel < 3; ++channel) {
                const double expected = profile->lineSpreadCumulative(channel, (dx + 0.5) * millimetresPerPixel);
                worst = larger(worst, std::abs(pixel[channel] - expected));
                EXPECT_NEAR(pixel[channel], expected, 0.01)
                    << material.name << ", " << dx << " px from the edge, channel " << channel;
            }
        }
        RecordProperty("worst_" + material.name, std::to_string(worst));
    }
};

TEST_P(EdgeTest, BruteSkin) {
    checkBrute(skin());
}
TEST_P(EdgeTest, BruteMarble) {
    checkBrute(marble());
}
TEST_P(EdgeTest, BruteBurley) {
    checkBrute(burley());
}

INSTANTIATE_TEST_SUITE_P(Footprints, EdgeTest, testing::Values(2.0, 6.0, 20.0, 60.0));

} // namespace
