// Transmit's filter against the sum over its taps: a plane lit from behind through bodies of uneven thickness.
#include "nacre/profile.hpp"
#include "tests/gpu/support/effect.hpp"

#include <cmath>
#include <functional>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr std::uint32_t imageSize = 48;
constexpr std::uint32_t mapSize = 512;
constexpr double focalLength = 600;   // px
constexpr double receiverDepth = 500; // mm before the camera
constexpr double lightDepth = 1000;
constexpr double extent = 120; // mm, half side of the shadow map
constexpr double shadowRange = 2000;

/// Thickness in mm under a texel of the shadow map; below 0, light enters before the plane.
using Body = std::function<double(int x, int y)>;

/// [0, 1), without pattern.
double noise(int x, int y) {
    std::uint32_t value = static_cast<std::uint32_t>(x) * 0x9e3779b9u + static_cast<std::uint32_t>(y) * 0x85ebca6bu;
    value = (value ^ value >> 15) * 0x2c1b3c6du;
    value = (value ^ value >> 12) * 0x297a2d39u;
    return (value >> 8) * 0x1p-24;
}

/// The taps of an axis at a coordinate in texels: a tent of radius 2.
struct Taps {
    explicit Taps(double coordinate) : first(static_cast<int>(std::floor(coordinate - 0.5)) - 1) {
        for (int i = 0; i < 4; ++i) {
            weights[i] = 0.5 - 0.25 * std::abs(first + i + 0.5 - coordinate);
        }
    }
    int first;
    double weights[4];
};

class TransmitFilterTest : public GpuTest {
protected:
    struct Error {
        double rms = 0;
        double largest = 0;
    };

    /// Shares of the light's irradiance that the picture is off the sum over the taps.
    Error error(const Material& material, const Body& body) {
        const auto profile = makeProfile(material);
        const std::vector<Float4> image = transmit(material, body);
        Error result;
        for (std::uint32_t y = 0; y < imageSize; ++y) {
            for (std::uint32_t x = 0; x < imageSize; ++x) {
                for (int channel = 0; channel < 3; ++channel) {
                    const double expected = tapSum(*profile, channel, body, x, y);
                    const double difference = std::abs(image[y * imageSize + x][channel] - expected);
                    // Not less than, so that NaN counts.
                    result.largest = difference <= result.largest ? result.largest : difference;
                    result.rms += difference * difference / (3 * imageSize * imageSize);
                }
            }
        }
        result.rms = std::sqrt(result.rms);
        return result;
    }

private:
    static double tapSum(const Profile& profile, int channel, const Body& body, std::uint32_t x, std::uint32_t y) {
        constexpr double texelsPerPixel = receiverDepth / focalLength * mapSize / (2 * extent);
        const Taps columns(0.5 * mapSize + (x + 0.5 - imageSize / 2.0) * texelsPerPixel);
        const Taps rows(0.5 * mapSize + (imageSize / 2.0 - y - 0.5) * texelsPerPixel);
        double sum = 0;
        for (int i = 0; i < 16; ++i) {
            const double thickness = std::max(body(columns.first + i % 4, rows.first + i / 4), 0.0);
            sum += columns.weights[i % 4] * rows.weights[i / 4] * profile.slabTransmittance(channel, thickness);
        }
        return sum;
    }

    /// The plane as the camera sees it; the light is behind it and shines at the camera with an irradiance of 1.
    std::vector<Float4> transmit(const Material& material, const Body& body) {
        std::vector<float> texels;
        for (std::uint32_t i = 0; i < mapSize * mapSize; ++i) {
            const double thickness = body(static_cast<int>(i % mapSize), static_cast<int>(i / mapSize));
            texels.push_back(static_cast<float>((lightDepth - receiverDepth - thickness) / shadowRange));
        }
        const GpuImage map = gpu.createShadowMap(mapSize, texels);
        const NacreImage maps[] = {map.nacre()};
        NacreLight light{};
        light.kind = NACRE_LIGHT_DIRECTIONAL;
        light.position[2] = -lightDepth;
        light.direction[2] = 1;
        std::fill(std::begin(light.irradiance), std::end(light.irradiance), 1.0f);
        light.shadowRange = shadowRange;
        light.shadowClipFromWorld[0] = light.shadowClipFromWorld[5] = static_cast<float>(1 / extent);
        light.shadowClipFromWorld[15] = 1;

        ScatterInput input = ScatterInput::plane(
            imageSize, imageSize, Projection::perspective(imageSize, imageSize, focalLength), receiverDepth);
        input.normal.assign(input.depth.size(), {0, 0, 1, 0});
        ScatterImages images(gpu, input);
        NacreContextInfo contextInfo = gpu.contextInfo(input.extent);
        contextInfo.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        Effect effect(gpu, contextInfo);
        std::vector<NacreLayer> layers;
        NacreMaterial translucent = toNacre(material, layers);
        translucent.translucency = 1;
        EXPECT_EQ(nacreSetMaterials(effect.context, 1, 1, &translucent), NACRE_SUCCESS);
        EXPECT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
        NacreTransmitInfo info{};
        info.view = input.view;
        info.depth = images.info.depth;
        info.materialId = images.info.materialId;
        info.normal = images.info.normal;
        info.lights = &light;
        info.lightCount = 1;
        info.shadowMaps = maps;
        info.shadowMapCount = 1;
        info.transmitted = images.scattered.nacre();
        gpu.run([&](VkCommandBuffer commandBuffer) {
            EXPECT_EQ(nacreCmdTransmit(effect.context, commandBuffer, &info), NACRE_SUCCESS);
        });
        return gpu.download<Float4>(images.scattered);
    }
};

TEST_F(TransmitFilterTest, TwoThicknessesAreExactAtAnyShares) {
    for (const Material& material : {skin(), marble(), burley()}) {
        SCOPED_TRACE(material.name);
        const Error silhouette = error(material, [](int x, int y) { return 2 * x + y < 768 ? 0.0 : 2.5; });
        EXPECT_LT(silhouette.largest, 1e-3);
        const Error mixture = error(material, [](int x, int y) { return noise(x, y) < 0.3 ? 0.2 : 3.0; });
        EXPECT_LT(mixture.largest, 1e-3);
    }
}

TEST_F(TransmitFilterTest, ManyThicknessesAreClose) {
    for (const Material& material : {skin(), marble(), burley()}) {
        SCOPED_TRACE(material.name);
        const Error ramp = error(material, [](int x, int y) { return std::max(0.05 * (x + 0.5 * y) - 18, 0.0); });
        EXPECT_LT(ramp.largest, 1e-3);
        const Error steps = error(material, [](int x, int y) { return (2 * x + y) % 11 * 0.7; });
        EXPECT_LT(steps.rms, 5e-3);
        EXPECT_LT(steps.largest, 0.02);
        const Error noisy = error(material, [](int x, int y) { return 0.05 * std::pow(200, noise(x, y)); });
        EXPECT_LT(noisy.rms, 6e-3);
        EXPECT_LT(noisy.largest, 0.03);
    }
}

TEST_F(TransmitFilterTest, ExtremesOfScaleAndThickness) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
        Material material = burley();
        material.scale = scale;
        SCOPED_TRACE(scale);
        EXPECT_LT(error(material, [](int x, int y) { return noise(x, y) < 0.5 ? -1.0 : 499.0; }).largest, 1e-3);
        EXPECT_LT(error(material, [](int, int) { return 499; }).largest, 1e-3);
        EXPECT_LT(error(material, [](int, int) { return -1; }).largest, 1e-3);
    }
}

TEST_F(TransmitFilterTest, MostLightLeavesWhereItEnters) {
    Material material;
    material.layers = {{{0.6, 0.6, 0.6}, 0}, {{0.4, 0.4, 0.4}, 4}};
    const Error noisy = error(material, [](int x, int y) { return 0.05 * std::pow(200, noise(x, y)); });
    EXPECT_LT(noisy.largest, 0.03);
}

} // namespace
