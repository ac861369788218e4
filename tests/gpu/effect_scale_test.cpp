// An image of scales multiplies the lengths of materials, pixel by pixel: what a constant one does is what
// NacreMaterial::scale does, and where light leaves decides.
#include "tests/gpu/support/effect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr VkExtent2D extent{96, 40};
constexpr std::uint32_t mapSize = 64;

/// Stripes of light on a plane with a step in it, of two materials.
ScatterInput scene() {
    ScatterInput input = ScatterInput::plane(extent.width, extent.height,
                                             Projection::perspective(extent.width, extent.height, 600), 300);
    for (std::uint32_t i = 0; i < extent.width * extent.height; ++i) {
        const std::uint32_t x = i % extent.width, y = i / extent.width;
        input.materialId[i] = static_cast<std::uint16_t>(y < 20 ? 1 : 2);
        input.irradiance[i] = x / 16 % 2 == 0 ? Float4{1, 0.8f, 0.6f, 1} : Float4{0.1f, 0, 0, 1};
        input.depth[i] = x < 70 ? 300.0f : 330.0f;
    }
    input.normal.assign(input.depth.size(), {0, 0, 1, 0});
    return input;
}

class ScaleTest : public GpuTest {
protected:
    ScaleTest() {
        NacreContextInfo info = gpu.contextInfo(extent);
        info.techniques = 0;
        effect_ = std::make_unique<Effect>(gpu, info);
        const std::vector<float> depths(mapSize * mapSize, 0.25f);
        map_ = gpu.createShadowMap(mapSize, depths);
    }
    /// Burley's profile and one of layers.
    void setMaterials(double scale) {
        Material materials[] = {burley(), marble()};
        for (Material& material : materials) {
            material.scale = scale;
        }
        effect_->setMaterials(materials);
    }
    std::vector<Float4> scatter(NacreTechnique technique, std::vector<float> scale) {
        ScatterInput input = scene();
        input.scale = std::move(scale);
        return effect_->scatter(input, technique);
    }
    /// Through a slab whose far side is 1 mm behind the nearer half of the plane.
    std::vector<Float4> transmit(std::vector<float> scale, float authored) {
        ScatterInput input = scene();
        input.scale = std::move(scale);
        const ScatterImages images(gpu, input);
        NacreLight light{};
        light.kind = NACRE_LIGHT_DIRECTIONAL;
        light.position[2] = -551;
        light.direction[2] = 1;
        std::fill_n(light.irradiance, 3, 1.0f);
        light.shadowMap = authored > 0 ? NACRE_NO_SHADOW_MAP : 0;
        light.shadowRange = 1000;
        light.shadowClipFromWorld[0] = light.shadowClipFromWorld[5] = 0.02f;
        light.shadowClipFromWorld[15] = 1;
        const NacreImage map = map_.nacre();
        NacreTransmitInfo info = images.transmitInfo({&light, 1}, {&map, 1});
        GpuImage thickness;
        if (authored > 0) {
            thickness = gpu.createImage({.format = VK_FORMAT_R32_SFLOAT,
                                         .extent = extent,
                                         .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                         .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
            gpu.upload(thickness, std::vector<float>(input.depth.size(), authored));
            info.thickness = thickness.nacre();
        }
        EXPECT_EQ(nacreBeginFrame(effect_->context, 0), NACRE_SUCCESS);
        gpu.run([&](VkCommandBuffer commands) {
            EXPECT_EQ(nacreCmdTransmit(effect_->context, commands, &info), NACRE_SUCCESS) << effect_->messages.back();
        });
        return gpu.download<Float4>(images.scattered);
    }
    static std::vector<float> constant(float scale) {
        return std::vector<float>(std::size_t{extent.width} * extent.height, scale);
    }
    static double psnrOf(const std::vector<Float4>& image, const std::vector<Float4>& reference) {
        return psnr(image, reference, scene().materialId);
    }

    std::unique_ptr<Effect> effect_;
    GpuImage map_;
};

constexpr NacreTechnique scaled[] = {NACRE_TECHNIQUE_SEPARABLE, NACRE_TECHNIQUE_BRUTE, NACRE_TECHNIQUE_BANK,
                                     NACRE_TECHNIQUE_BURLEY, NACRE_TECHNIQUE_BANK_SURFACES};

TEST_F(ScaleTest, AConstantImageIsTheMaterialsScale) {
    for (const NacreTechnique technique : scaled) {
        SCOPED_TRACE(nacreTechniqueString(technique));
        for (const float scale : {0.25f, 3.0f}) {
            setMaterials(scale);
            const std::vector<Float4> expected = scatter(technique, {});
            setMaterials(1);
            EXPECT_GT(psnrOf(scatter(technique, constant(scale)), expected), 60) << scale;
            EXPECT_LT(psnrOf(scatter(technique, {}), expected), 40) << "the scale is seen";
        }
        EXPECT_GT(psnrOf(scatter(technique, constant(1)), scatter(technique, {})), 100);
    }
}

TEST_F(ScaleTest, AConstantImageIsTheMaterialsScaleForLightThatComesThrough) {
    for (const float authored : {0.0f, 0.8f}) {
        for (const float scale : {0.5f, 3.0f}) {
            setMaterials(scale);
            const std::vector<Float4> expected = transmit({}, authored);
            setMaterials(1);
            EXPECT_GT(psnrOf(transmit(constant(scale), authored), expected), 60) << scale << ", authored " << authored;
            EXPECT_LT(psnrOf(transmit({}, authored), expected), 40) << "the scale is seen";
        }
        EXPECT_GT(psnrOf(transmit(constant(1), authored), transmit({}, authored)), 80);
    }
}

TEST_F(ScaleTest, WhereLightLeavesDecides) {
    setMaterials(1);
    std::vector<float> halves = constant(0.5f);
    for (std::size_t i = 0; i < halves.size(); ++i) {
        halves[i] = i % extent.width < 48 ? 0.5f : 2.0f;
    }
    for (const NacreTechnique technique : scaled) {
        SCOPED_TRACE(nacreTechniqueString(technique));
        // The second pass of separable gathers what the first one has scattered elsewhere.
        const double least = technique == NACRE_TECHNIQUE_SEPARABLE ? 55 : 100;
        std::vector<Float4> expected = scatter(technique, constant(0.5f));
        const std::vector<Float4> wide = scatter(technique, constant(2));
        for (std::size_t i = 0; i < expected.size(); ++i) {
            expected[i] = halves[i] == 2 ? wide[i] : expected[i];
        }
        EXPECT_GT(psnrOf(scatter(technique, halves), expected), least);
    }
    std::vector<Float4> expected = transmit(constant(0.5f), 0);
    const std::vector<Float4> wide = transmit(constant(2), 0);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        expected[i] = halves[i] == 2 ? wide[i] : expected[i];
    }
    EXPECT_EQ(transmit(halves, 0), expected);
}

TEST_F(ScaleTest, EveryValueIsBounded) {
    setMaterials(1);
    const float infinity = std::numeric_limits<float>::infinity();
    const std::pair<float, float> values[] = {{0.0f, 1e-3f}, {-2.0f, 1e-3f}, {1e9f, 1e3f},
                                              {infinity, 1}, {-infinity, 1}, {std::nanf(""), 1}};
    for (const NacreTechnique technique : {NACRE_TECHNIQUE_BANK, NACRE_TECHNIQUE_SEPARABLE}) {
        for (const auto& [value, meant] : values) {
            EXPECT_EQ(scatter(technique, constant(value)), scatter(technique, constant(meant)))
                << nacreTechniqueString(technique) << ", " << value;
        }
    }
    for (const auto& [value, meant] : values) {
        EXPECT_EQ(transmit(constant(value), 0), transmit(constant(meant), 0)) << value;
    }
    // The smallest leaves light where it enters.
    const ScatterInput input = scene();
    EXPECT_GT(psnrOf(scatter(NACRE_TECHNIQUE_BANK, constant(0)), input.irradiance), 50);
}

} // namespace
