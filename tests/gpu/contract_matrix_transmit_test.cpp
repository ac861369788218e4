// Transmit in every combination of projections, optional images and parts of images (stereo among them), in formats of
// which every two meet, against itself in the plainest formats and all of an image, and against the closed form where
// the thickness is given.
#include "tests/gpu/support/matrix.hpp"

#include <cmath>
#include <cstdio>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr float translucency = 0.6f;
/// The distance along the light at which it enters, over the range: behind the plane at z = -300 … -303.5 mm.
constexpr float entry = 0.295f;

struct Pictures {
    std::vector<std::vector<Float4>> light;
    std::vector<std::vector<float>> thickness;
};

class TransmitMatrixTest : public GpuTest {
protected:
    TransmitMatrixTest() {
        NacreContextInfo info = gpu.contextInfo(matrixLarger);
        info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        info.recordsPerFrame = 64;
        effect_ = std::make_unique<Effect>(gpu, info);
        Material both[] = {skin(), burley()};
        both[0].translucency = both[1].translucency = translucency;
        effect_->setMaterials(both);
    }
    GpuImage shadowMap() { return gpu.createShadowMap(70, std::vector<float>(70 * 70, entry)); }
    Pictures transmit(MatrixImages& images, const NacreImage& map) {
        EXPECT_EQ(nacreBeginFrame(effect_->context, 0), NACRE_SUCCESS);
        gpu.run([&](VkCommandBuffer commandBuffer) {
            for (std::size_t call = 0; call < images.calls().size(); ++call) {
                const NacreTransmitInfo info = images.transmitInfo(call, map);
                EXPECT_EQ(nacreCmdTransmit(effect_->context, commandBuffer, &info), NACRE_SUCCESS)
                    << effect_->messages.back();
            }
        });
        return {images.results(), images.thicknesses()};
    }
    /// The closed form where a thickness is given that is less than the map's: T(thickness) times the light that falls
    /// on the far side.
    void expectClosedForm(const MatrixCall& call, const std::vector<Float4>& picture) {
        const std::unique_ptr<Profile> profiles[] = {makeProfile(skin()), makeProfile(burley())};
        const double share = translucency * (call.optional & MatrixTransmitStrength ? matrixStrength : 1.0);
        for (std::size_t i = 0; i < picture.size(); ++i) {
            const std::size_t x = i % matrixArea.width;
            const std::size_t y = i / matrixArea.width;
            for (int channel = 0; channel < 3; ++channel) {
                const Profile& profile = *profiles[x < 20 ? 0 : 1];
                const double expected =
                    y < 3 ? 0 : share * profile.slabTransmittance(channel, matrixThickness) * matrixNormal[2];
                ASSERT_NEAR(picture[i][channel], expected, 0.01 * expected + 1e-3)
                    << x << ", " << y << ", channel " << channel;
            }
        }
    }

    std::unique_ptr<Effect> effect_;
};

TEST_F(TransmitMatrixTest, FollowsItselfAndTheClosedForm) {
    const GpuImage map = shadowMap();
    Pictures plain;
    for (const int eye : {0, 1}) {
        MatrixImages images(gpu, {}, MatrixPart::Whole, eye);
        const Pictures seen = transmit(images, map.nacre());
        plain.light.insert(plain.light.end(), seen.light.begin(), seen.light.end());
        plain.thickness.insert(plain.thickness.end(), seen.thickness.begin(), seen.thickness.end());
        for (std::size_t i = 0; i < images.calls().size(); ++i) {
            if (images.calls()[i].optional & MatrixThickness) {
                expectClosedForm(images.calls()[i], seen.light[i]);
            } else { // through some millimetres, more and more
                EXPECT_GT(seen.light[i][5 * matrixArea.width][0], 0.005);
                EXPECT_GT(seen.light[i][5 * matrixArea.width + 2][0], seen.light[i][5 * matrixArea.width][0]);
            }
        }
    }
    int calls = 0;
    for (const MatrixFormats& formats : matrixFormats()) {
        for (const MatrixPart part : matrixParts) {
            MatrixImages images(gpu, formats, part);
            const Pictures seen = transmit(images, map.nacre());
            for (std::size_t i = 0; i < seen.light.size(); ++i, ++calls) {
                EXPECT_LT(largestDifference(seen.light[i], plain.light[i]), formats.step) << images.description(i);
                for (std::size_t pixel = 0;
                     images.calls()[i].optional & MatrixThicknessOut && pixel < seen.thickness[i].size(); ++pixel) {
                    ASSERT_NEAR(seen.thickness[i][pixel], plain.thickness[i][pixel], 2e-3) << images.description(i);
                }
            }
        }
    }
    std::printf("transmit: %d calls\n", calls);
}

} // namespace
