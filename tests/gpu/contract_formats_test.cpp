// Every format that nacreGetImageRequirements lists, of every image, gives the picture of the plainest one. Images are
// filled with one value by Vulkan itself, which converts it.
#include "tests/gpu/support/effect.hpp"

#include <algorithm>
#include <cmath>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr VkExtent2D extent{20, 12};
/// Half of it is in every format: hardware depth of a plane 300 mm away with the near plane at 150.
constexpr float storedDepth = 0.5f;

bool isDepth(VkFormat format) {
    return format == VK_FORMAT_D16_UNORM || format == VK_FORMAT_X8_D24_UNORM_PACK32 ||
           format == VK_FORMAT_D24_UNORM_S8_UINT || format == VK_FORMAT_D32_SFLOAT ||
           format == VK_FORMAT_D32_SFLOAT_S8_UINT || format == VK_FORMAT_D16_UNORM_S8_UINT;
}

bool isUnsigned(VkFormat format) {
    return format == VK_FORMAT_R16G16B16A16_UNORM || format == VK_FORMAT_R8G8B8A8_UNORM ||
           format == VK_FORMAT_A2B10G10R10_UNORM_PACK32;
}

bool isOctahedral(VkFormat format) {
    return format == VK_FORMAT_R16G16_SFLOAT || format == VK_FORMAT_R16G16_SNORM || format == VK_FORMAT_R16G16_UNORM ||
           format == VK_FORMAT_R8G8_SNORM || format == VK_FORMAT_R8G8_UNORM || format == VK_FORMAT_R32G32_SFLOAT;
}

/// What the effect's slots hold here.
VkClearColorValue valueOf(NacreImageSlot slot, VkFormat format) {
    switch (slot) {
    case NACRE_IMAGE_IRRADIANCE:
        return {{1, 0.5f, 0.25f, 1}};
    case NACRE_IMAGE_MATERIAL_ID: {
        VkClearColorValue value{};
        value.uint32[0] = 1;
        return value;
    }
    case NACRE_IMAGE_NORMAL: // (0, 0, 1), in formats without sign as 0.5 · n + 0.5
        return isUnsigned(format) ? VkClearColorValue{{0.5f, 0.5f, 1, 0}} : VkClearColorValue{{0, 0, 1, 0}};
    case NACRE_IMAGE_ALBEDO:
        return {{0.5f, 0.25f, 0.75f, 1}};
    case NACRE_IMAGE_SCALE:
    case NACRE_IMAGE_THICKNESS:
        return {{0.75f}};
    case NACRE_IMAGE_SHADOW_MAP:
        return {{0.25f}};
    default: // depth, strength
        return {{storedDepth}};
    }
}

class FormatsTest : public GpuTest {
protected:
    FormatsTest() {
        NacreContextInfo info = gpu.contextInfo(extent);
        info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        effect_ = std::make_unique<Effect>(gpu, info);
        const Material material = marble();
        effect_->setMaterials({&material, 1});
        for (int slot = 0; slot < NACRE_IMAGE_SLOT_COUNT; ++slot) {
            images_[slot] = createImage(static_cast<NacreImageSlot>(slot), plainFormat(slot));
        }
    }
    static NacreImageRequirements requirementsOf(int slot) {
        NacreImageRequirements requirements{};
        EXPECT_EQ(nacreGetImageRequirements(static_cast<NacreImageSlot>(slot), &requirements), NACRE_SUCCESS);
        return requirements;
    }
    /// 32-bit floats where they are listed.
    static VkFormat plainFormat(int slot) {
        const NacreImageRequirements requirements = requirementsOf(slot);
        const std::span formats(requirements.formats, requirements.formatCount);
        for (const VkFormat format : {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32_SFLOAT}) {
            if (std::find(formats.begin(), formats.end(), format) != formats.end()) {
                return format;
            }
        }
        return formats.front();
    }
    bool isSupported(VkFormat format, VkImageUsageFlags usage) const {
        VkImageFormatProperties properties;
        return vkGetPhysicalDeviceImageFormatProperties(
                   gpu.physicalDevice, format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL,
                   usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT, 0, &properties) == VK_SUCCESS;
    }
    GpuImage createImage(NacreImageSlot slot, VkFormat format) {
        const NacreImageRequirements requirements = requirementsOf(slot);
        const bool isStencil = slot == NACRE_IMAGE_MATERIAL_ID && (isDepth(format) || format == VK_FORMAT_S8_UINT);
        GpuImage image = gpu.createImage({.format = format,
                                          .extent = extent,
                                          .usage = requirements.usage,
                                          .array = slot == NACRE_IMAGE_SHADOW_MAP,
                                          .stencil = isStencil});
        gpu.run([&](VkCommandBuffer commandBuffer) {
            const VkClearColorValue color = valueOf(slot, format);
            const VkClearDepthStencilValue depth{isStencil ? 0 : color.float32[0], 1};
            VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
            if (isDepth(format) || isStencil) {
                range.aspectMask = isStencil ? VK_IMAGE_ASPECT_STENCIL_BIT : VK_IMAGE_ASPECT_DEPTH_BIT;
                vkCmdClearDepthStencilImage(commandBuffer, image.image, VK_IMAGE_LAYOUT_GENERAL, &depth, 1, &range);
            } else {
                vkCmdClearColorImage(commandBuffer, image.image, VK_IMAGE_LAYOUT_GENERAL, &color, 1, &range);
            }
        });
        return image;
    }

    /// Both calls with these images; the outputs are as their slots say.
    void render(const std::array<NacreImage, NACRE_IMAGE_SLOT_COUNT>& images) {
        NacreScatterInfo scatter{};
        scatter.view = makeView(Projection::perspective(extent.width, extent.height, 600));
        scatter.view.clipFromView[14] = 150;
        scatter.view.depthEncoding = NACRE_DEPTH_HARDWARE;
        scatter.irradiance = images[NACRE_IMAGE_IRRADIANCE];
        scatter.depth = images[NACRE_IMAGE_DEPTH];
        scatter.materialId = images[NACRE_IMAGE_MATERIAL_ID];
        scatter.normal = images[NACRE_IMAGE_NORMAL];
        scatter.normalScale = isUnsigned(scatter.normal.format) ? 2.0f : 1.0f;
        scatter.normalBias = isUnsigned(scatter.normal.format) ? -1.0f : 0.0f;
        scatter.strength = images[NACRE_IMAGE_STRENGTH];
        scatter.scale = images[NACRE_IMAGE_SCALE];
        scatter.albedo = images[NACRE_IMAGE_ALBEDO];
        scatter.scattered = images[NACRE_IMAGE_SCATTERED];
        NacreLight light{};
        light.position[2] = -552; // the light enters 250 mm from there, 2 mm behind the plane
        light.direction[2] = 1;
        light.irradiance[0] = light.irradiance[1] = light.irradiance[2] = 1;
        light.shadowRange = 1000;
        light.shadowClipFromWorld[0] = light.shadowClipFromWorld[5] = 0.02f;
        light.shadowClipFromWorld[15] = 1;
        if (isDepth(images[NACRE_IMAGE_SHADOW_MAP].format)) { // the same range, orthographic
            light.shadowDepthEncoding = NACRE_DEPTH_HARDWARE;
            light.shadowClipFromWorld[10] = 1e-3f;
            light.shadowClipFromWorld[14] = 0.552f;
        }
        NacreTransmitInfo transmit{};
        transmit.view = scatter.view;
        transmit.depth = scatter.depth;
        transmit.materialId = scatter.materialId;
        transmit.normal = scatter.normal;
        transmit.normalScale = scatter.normalScale;
        transmit.normalBias = scatter.normalBias;
        transmit.strength = scatter.strength;
        transmit.scale = scatter.scale;
        transmit.thickness = images[NACRE_IMAGE_THICKNESS];
        transmit.lightCount = 1;
        transmit.lights = &light;
        transmit.shadowMapCount = 1;
        transmit.shadowMaps = &images[NACRE_IMAGE_SHADOW_MAP];
        transmit.transmitted = images[NACRE_IMAGE_TRANSMITTED];
        transmit.thicknessOut = images[NACRE_IMAGE_THICKNESS_OUT];
        scatter.technique = NACRE_TECHNIQUE_SEPARABLE;
        ASSERT_EQ(nacreBeginFrame(effect_->context, 0), NACRE_SUCCESS);
        gpu.run([&](VkCommandBuffer commandBuffer) {
            EXPECT_EQ(nacreCmdScatter(effect_->context, commandBuffer, &scatter), NACRE_SUCCESS)
                << effect_->messages.back();
            EXPECT_EQ(nacreCmdTransmit(effect_->context, commandBuffer, &transmit), NACRE_SUCCESS)
                << effect_->messages.back();
        });
    }

    struct Result {
        Float4 scattered, transmitted;
        float thickness;
    };
    /// Of the pixel in the middle, through outputs in the plainest formats.
    Result resultOf(std::array<NacreImage, NACRE_IMAGE_SLOT_COUNT> images) {
        render(images);
        const std::size_t middle = extent.height / 2 * extent.width + extent.width / 2;
        return {gpu.download<Float4>(images_[NACRE_IMAGE_SCATTERED])[middle],
                gpu.download<Float4>(images_[NACRE_IMAGE_TRANSMITTED])[middle],
                gpu.download<float>(images_[NACRE_IMAGE_THICKNESS_OUT])[middle]};
    }
    /// All but scales, with which a software device compiles more for every format.
    std::array<NacreImage, NACRE_IMAGE_SLOT_COUNT> plain() const {
        std::array<NacreImage, NACRE_IMAGE_SLOT_COUNT> images;
        for (int slot = 0; slot < NACRE_IMAGE_SLOT_COUNT; ++slot) {
            images[slot] = images_[slot].nacre();
        }
        images[NACRE_IMAGE_SCALE] = {};
        return images;
    }

    std::unique_ptr<Effect> effect_;
    std::array<GpuImage, NACRE_IMAGE_SLOT_COUNT> images_;
};

/// What 8 bits, and 5 bits of mantissa, may be off.
constexpr double tolerance = 0.01;

TEST_F(FormatsTest, EveryInput) {
    // Without the authored thickness it is the depth and the shadow map that count.
    const auto unbounded = [](std::array<NacreImage, NACRE_IMAGE_SLOT_COUNT> images) {
        images[NACRE_IMAGE_THICKNESS] = {};
        return images;
    };
    const Result bounded = resultOf(plain());
    const Result measured = resultOf(unbounded(plain()));
    std::array<NacreImage, NACRE_IMAGE_SLOT_COUNT> scaledImages = plain();
    scaledImages[NACRE_IMAGE_SCALE] = images_[NACRE_IMAGE_SCALE].nacre();
    const Result scaled = resultOf(scaledImages);
    EXPECT_LT(scaled.transmitted[0], 0.9f * bounded.transmitted[0]);
    // Light 1, 0.5, 0.25 everywhere, times the albedo; 0.75 mm, and the shadow map's 2 mm.
    EXPECT_NEAR(bounded.scattered[0], 0.5, 1e-3);
    EXPECT_NEAR(bounded.scattered[1], 0.125, 1e-3);
    EXPECT_NEAR(bounded.thickness, 0.75, 1e-3);
    EXPECT_NEAR(measured.thickness, 2, 1e-2);
    EXPECT_GT(bounded.transmitted[0], 0.1);
    EXPECT_GT(measured.transmitted[0], 0.02);
    int formats = 0;
    for (int slot = 0; slot < NACRE_IMAGE_SCATTERED; ++slot) {
        const NacreImageRequirements requirements = requirementsOf(slot);
        for (std::uint32_t i = 0; i < requirements.formatCount; ++i) {
            const VkFormat format = requirements.formats[i];
            if (slot == NACRE_IMAGE_NORMAL && isOctahedral(format)) {
                continue; // of a context of their own: effect_encodings_test.cpp
            }
            if (!isSupported(format, requirements.usage)) {
                continue;
            }
            ++formats;
            SCOPED_TRACE(std::string(requirements.name) + ", VkFormat " + std::to_string(format));
            const bool isMeasured = slot == NACRE_IMAGE_SHADOW_MAP || slot == NACRE_IMAGE_DEPTH;
            const GpuImage image = createImage(static_cast<NacreImageSlot>(slot), format);
            std::array<NacreImage, NACRE_IMAGE_SLOT_COUNT> images = isMeasured ? unbounded(plain()) : plain();
            images[slot] = image.nacre();
            const Result result = resultOf(images);
            const Result& expected = isMeasured ? measured : slot == NACRE_IMAGE_SCALE ? scaled : bounded;
            EXPECT_NEAR(result.thickness, expected.thickness, 0.05);
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(result.scattered[channel], expected.scattered[channel], tolerance);
                EXPECT_NEAR(result.transmitted[channel], expected.transmitted[channel], tolerance);
            }
        }
    }
    EXPECT_GT(formats, 30) << "the device supports most of them";
}

TEST_F(FormatsTest, EveryOutput) {
    const Result expected = resultOf(plain());
    for (const NacreImageSlot slot : {NACRE_IMAGE_SCATTERED, NACRE_IMAGE_TRANSMITTED, NACRE_IMAGE_THICKNESS_OUT}) {
        const NacreImageRequirements requirements = requirementsOf(slot);
        for (std::uint32_t i = 0; i < requirements.formatCount; ++i) {
            const VkFormat format = requirements.formats[i];
            ASSERT_TRUE(isSupported(format, requirements.usage)) << requirements.name << ", VkFormat " << format;
            std::array<NacreImage, NACRE_IMAGE_SLOT_COUNT> images = plain();
            const GpuImage image = createImage(slot, format);
            images[slot] = image.nacre();
            render(images);
            const std::size_t middle = extent.height / 2 * extent.width + extent.width / 2;
            const Float4 wanted = slot == NACRE_IMAGE_SCATTERED     ? expected.scattered
                                  : slot == NACRE_IMAGE_TRANSMITTED ? expected.transmitted
                                                                    : Float4{expected.thickness};
            const Float4 got = downloadLight(gpu, image)[middle];
            for (int channel = 0; channel < (slot == NACRE_IMAGE_THICKNESS_OUT ? 1 : 3); ++channel) {
                EXPECT_NEAR(got[channel], wanted[channel], 0.02 * wanted[channel])
                    << requirements.name << ", VkFormat " << format;
            }
        }
    }
}

} // namespace
