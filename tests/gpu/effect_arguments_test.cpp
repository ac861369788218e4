// Wrong arguments get a result code and a message that names the field and its value, and leave the command buffer as
// it was.
#include "tests/gpu/support/counted_calls.hpp"
#include "tests/gpu/support/effect.hpp"

#include <cmath>
#include <functional>
#include <limits>

using namespace nacre;
using namespace nacre::tests;

namespace {

const float nan = std::numeric_limits<float>::quiet_NaN();

class ArgumentsTest : public GpuTest {
protected:
    ArgumentsTest() : input_(ScatterInput::plane(16, 16, Projection::perspective(16, 16, 100), 500)) {
        input_.normal.assign(input_.depth.size(), {0, 0, 1, 0});
    }

    NacreContextInfo info() const {
        NacreContextInfo result = gpu.contextInfo({16, 16});
        result.getInstanceProcAddr = countingGetInstanceProcAddr;
        result.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        return result;
    }

    /// Expects this result, one message that contains `text`, and no command.
    void expectRefusal(Effect& effect, NacreResult expected, const std::string& text,
                       const std::function<NacreResult(VkCommandBuffer)>& call) {
        effect.messages.clear();
        callCounts() = {};
        gpu.run([&](VkCommandBuffer commandBuffer) {
            EXPECT_STREQ(nacreResultString(call(commandBuffer)), nacreResultString(expected)) << text;
        });
        ASSERT_EQ(effect.messages.size(), 1u) << text;
        EXPECT_NE(effect.messages[0].find(text), std::string::npos) << effect.messages[0];
        EXPECT_EQ(callCounts().commands, 0) << "the command buffer was touched: " << text;
    }

    ScatterInput input_;
};

TEST_F(ArgumentsTest, Scatter) {
    struct Case {
        std::function<void(NacreScatterInfo&)> change;
        NacreResult result;
        const char* text;
    };
    const Case cases[] = {
        {[](auto& i) { i.irradiance.view = VK_NULL_HANDLE; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::irradiance.view is null"},
        {[](auto& i) { i.depth.view = VK_NULL_HANDLE; }, NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::depth.view"},
        {[](auto& i) { i.materialId.view = VK_NULL_HANDLE; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::materialId.view"},
        {[](auto& i) { i.scattered.view = VK_NULL_HANDLE; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::scattered.view"},
        {[](auto& i) { i.scattered.view = i.irradiance.view; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::scattered.view is the irradiance's"},
        {[](auto& i) { i.irradiance.format = VK_FORMAT_R8G8B8A8_UNORM; }, NACRE_ERROR_UNSUPPORTED_FORMAT,
         "NacreScatterInfo::irradiance.format is VK_FORMAT_R8G8B8A8_UNORM"},
        {[](auto& i) { i.materialId.format = VK_FORMAT_R32_UINT; }, NACRE_ERROR_UNSUPPORTED_FORMAT,
         "NacreScatterInfo::materialId.format is VK_FORMAT_R32_UINT"},
        {[](auto& i) { i.scattered.usage = VK_IMAGE_USAGE_SAMPLED_BIT; }, NACRE_ERROR_UNSUPPORTED_FORMAT,
         "NacreScatterInfo::scattered.usage is 0x4, lacks 0x8"},
        {[](auto& i) { i.depth.layout = VK_IMAGE_LAYOUT_UNDEFINED; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::depth.layout is VK_IMAGE_LAYOUT_UNDEFINED"},
        {[](auto& i) { i.depth.layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_STENCIL_READ_ONLY_OPTIMAL; },
         NACRE_ERROR_INVALID_ARGUMENT, "must be a read-only layout"},
        {[](auto& i) {
             i.depth.extent = {8, 16};
         },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::depth.extent is 8x16"},
        {[](auto& i) {
             i.irradiance.extent = {0, 0};
         },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::view.renderArea.extent is 0x0"},
        {[](auto& i) {
             i.view.renderArea = {{8, 8}, {16, 4}};
         },
         NACRE_ERROR_INVALID_ARGUMENT, "the render area reaches to 24x12"},
        {[](auto& i) {
             i.view.renderArea = {{-1, 0}, {4, 4}};
         },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::view.renderArea.offset is -1,0"},
        {[](auto& i) {
             i.view.renderArea = {{0, 0}, {17, 4}};
         },
         NACRE_ERROR_LIMIT_EXCEEDED, "is 17x4"},
        {[](auto& i) { i.view.clipFromView[5] = nan; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::view.clipFromView[5] is nan"},
        {[](auto& i) { i.view.clipFromView[0] = 0; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::view.clipFromView is not a projection"},
        {[](auto& i) { i.view.clipFromView[11] = 1; }, NACRE_ERROR_INVALID_ARGUMENT, "looks along -Z"},
        {[](auto& i) { i.view.metersPerUnit = -1; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::view.metersPerUnit is -1"},
        {[](auto& i) { i.view.viewFromWorld[0] = 2; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::view.viewFromWorld is not a rotation"},
        {[](auto& i) { i.view.depthEncoding = static_cast<NacreDepthEncoding>(7); }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::view.depthEncoding is 7"},
        {[](auto& i) { i.normalScale = nan; }, NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::normalScale"},
        {[](auto& i) { i.technique = static_cast<NacreTechnique>(99); }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::technique is 99"},
        {[](auto& i) { i.technique = NACRE_TECHNIQUE_BRUTE; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreScatterInfo::technique is brute"},
    };
    ScatterImages images(gpu, input_);
    images.info.technique = NACRE_TECHNIQUE_SEPARABLE;
    Effect effect(gpu, info());
    ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
    for (const Case& one : cases) {
        NacreScatterInfo wrong = images.info;
        one.change(wrong);
        expectRefusal(effect, one.result, one.text, [&](VkCommandBuffer commandBuffer) {
            return nacreCmdScatter(effect.context, commandBuffer, &wrong);
        });
    }
    expectRefusal(effect, NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo is null", [&](VkCommandBuffer commandBuffer) {
        return nacreCmdScatter(effect.context, commandBuffer, nullptr);
    });
    expectRefusal(effect, NACRE_ERROR_INVALID_ARGUMENT, "commandBuffer is null",
                  [&](VkCommandBuffer) { return nacreCmdScatter(effect.context, VK_NULL_HANDLE, &images.info); });
    // None of the refusals has used up the frame's one record; the second success would.
    gpu.run([&](VkCommandBuffer commandBuffer) {
        EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &images.info), NACRE_SUCCESS);
    });
    expectRefusal(effect, NACRE_ERROR_LIMIT_EXCEEDED, "already has its 1 records", [&](VkCommandBuffer commandBuffer) {
        return nacreCmdScatter(effect.context, commandBuffer, &images.info);
    });
    Effect unbegun(gpu, info());
    expectRefusal(
        unbegun, NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo belongs to no frame, nacreBeginFrame comes first",
        [&](VkCommandBuffer commandBuffer) { return nacreCmdScatter(unbegun.context, commandBuffer, &images.info); });
    EXPECT_EQ(nacreCmdScatter(nullptr, VK_NULL_HANDLE, &images.info), NACRE_ERROR_INVALID_ARGUMENT);
}

TEST_F(ArgumentsTest, Transmit) {
    struct Case {
        std::function<void(NacreTransmitInfo&, NacreLight&)> change;
        NacreResult result;
        const char* text;
    };
    ScatterImages images(gpu, input_);
    NacreImage good = images.info.depth; // of a format that shadow maps have, too
    const NacreShadowCascade cascade{};
    const auto changed = [&good](auto change) {
        NacreImage image = good;
        change(image);
        return image;
    };
    const NacreImage noView = changed([](NacreImage& image) { image.view = VK_NULL_HANDLE; });
    const NacreImage badFormat = changed([](NacreImage& image) { image.format = VK_FORMAT_R16G16B16A16_SFLOAT; });
    const NacreImage noExtent = changed([](NacreImage& image) { image.extent = {}; });
    const Case cases[] = {
        {[](auto& i, auto&) { i.normal.view = VK_NULL_HANDLE; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::normal.view is null"},
        {[](auto& i, auto&) { i.lightCount = 17; }, NACRE_ERROR_LIMIT_EXCEEDED, "NacreTransmitInfo::lightCount is 17"},
        {[](auto& i, auto&) { i.lights = nullptr; }, NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::lights is null"},
        {[](auto& i, auto&) { i.shadowMapCount = 17; }, NACRE_ERROR_LIMIT_EXCEEDED,
         "NacreTransmitInfo::shadowMapCount is 17"},
        {[](auto& i, auto&) { i.normalOffset = -1; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::normalOffset is -1"},
        {[](auto& i, auto&) { i.filterRadius = nan; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::filterRadius is nan"},
        {[](auto&, auto& l) { l.kind = static_cast<NacreLightKind>(3); }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].kind is 3"},
        {[](auto&, auto& l) { l.direction[2] = 0; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].direction is 0,0,0"},
        {[](auto&, auto& l) { l.position[1] = nan; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].position[1] is nan"},
        {[](auto&, auto& l) { l.irradiance[0] = -2; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].irradiance is -2"},
        {[](auto&, auto& l) { l.shadowMap = 0; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].shadowMap is 0, NacreTransmitInfo::shadowMapCount is 0"},
        {[](auto& i, auto&) { i.depth.view = VK_NULL_HANDLE; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::depth.view is null"},
        {[](auto& i, auto&) { i.materialId.view = VK_NULL_HANDLE; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::materialId.view is null"},
        {[](auto& i, auto&) { i.transmitted.view = VK_NULL_HANDLE; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::transmitted.view is null"},
        {[](auto& i, auto&) { i.transmitted.usage = VK_IMAGE_USAGE_SAMPLED_BIT; }, NACRE_ERROR_UNSUPPORTED_FORMAT,
         "NacreTransmitInfo::transmitted.usage is 0x4, lacks 0x8"},
        {[](auto& i, auto&) { i.thickness = i.depth, i.thickness.format = VK_FORMAT_R8_UNORM; },
         NACRE_ERROR_UNSUPPORTED_FORMAT, "NacreTransmitInfo::thickness.format is VK_FORMAT_R8_UNORM"},
        {[](auto& i, auto&) {
             i.depth.extent = {0, 16};
         },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::view.renderArea.extent is 0x16"},
        {[](auto& i, auto&) { i.view.viewFromWorld[5] = 3; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::view.viewFromWorld is not a rotation"},
        {[](auto& i, auto&) { i.shadowMapCount = 1; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::shadowMaps is null"},
        {[&](auto& i, auto&) { i.shadowMaps = &noView, i.shadowMapCount = 1; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::shadowMaps[0].view is null"},
        {[&](auto& i, auto&) { i.shadowMaps = &badFormat, i.shadowMapCount = 1; }, NACRE_ERROR_UNSUPPORTED_FORMAT,
         "NacreTransmitInfo::shadowMaps[0].format is VK_FORMAT_R16G16B16A16_SFLOAT"},
        {[&](auto& i, auto&) { i.shadowMaps = &noExtent, i.shadowMapCount = 1; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::shadowMaps[0].extent is 0x0"},
        {[&](auto& i, auto& l) { i.shadowMaps = &good, i.shadowMapCount = 1, l.shadowMap = 0, l.shadowRange = 0; },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::lights[0].shadowRange is 0"},
        {[&](auto& i, auto& l) {
             i.shadowMaps = &good, i.shadowMapCount = 1, l.shadowMap = 0, l.shadowRange = 1;
             l.shadowClipFromWorld[3] = nan;
         },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::lights[0].shadowClipFromWorld[3] is nan"},
        {[](auto&, auto& l) { l.attenuation[1] = -1; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].attenuation is -1"},
        {[](auto&, auto& l) { l.shadowDepthEncoding = static_cast<NacreDepthEncoding>(4); },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::lights[0].shadowDepthEncoding is 4"},
        {[](auto&, auto& l) { l.cascadeChoice = static_cast<NacreCascadeChoice>(4); }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].cascadeChoice is 4"},
        {[](auto&, auto& l) { l.cascadeCount = 17; }, NACRE_ERROR_LIMIT_EXCEEDED,
         "NacreTransmitInfo::lights[0].cascadeCount is 17, at most 16"},
        {[&](auto&, auto& l) { l.kind = NACRE_LIGHT_POINT, l.cascadeCount = 1, l.cascades = &cascade; },
         NACRE_ERROR_INVALID_ARGUMENT, "a point light has a cube in place of cascades"},
        {[&](auto&, auto& l) { l.cascadeCount = 1, l.cascades = &cascade; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].cascades[0].shadowMap is 0, NacreTransmitInfo::shadowMapCount is 0"},
        {[&](auto& i, auto& l) {
             i.shadowMaps = &good, i.shadowMapCount = 1;
             l.cascadeCount = 1, l.cascades = &cascade, l.cascadeBlend = 2;
         },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::lights[0].cascadeBlend is 2"},
        {[&](auto& i, auto& l) {
             i.shadowMaps = &good, i.shadowMapCount = 1, l.cascadeCount = 1, l.cascades = &cascade;
         },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::lights[0].cascades[0].range is 0, must be positive"},
        {[](auto&, auto& l) { l.range = nan; }, NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::lights[0].range"},
        {[](auto&, auto& l) { l.kind = NACRE_LIGHT_SPOT, l.outerConeAngle = 2; }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].outerConeAngle is 2"},
        {[](auto&, auto& l) { l.kind = NACRE_LIGHT_SPOT, l.outerConeAngle = 0.5f, l.innerConeAngle = 0.6f; },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::lights[0].innerConeAngle is 0.6"},
    };
    Effect effect(gpu, info());
    ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
    for (const Case& one : cases) {
        NacreTransmitInfo wrong = images.transmitInfo();
        NacreLight light{};
        light.direction[2] = 1;
        light.shadowMap = NACRE_NO_SHADOW_MAP;
        wrong.lights = &light;
        wrong.lightCount = 1;
        one.change(wrong, light);
        expectRefusal(effect, one.result, one.text, [&](VkCommandBuffer commandBuffer) {
            return nacreCmdTransmit(effect.context, commandBuffer, &wrong);
        });
    }
}

TEST_F(ArgumentsTest, Materials) {
    Effect effect(gpu, info());
    NacreLayer layers[33] = {};
    for (NacreLayer& layer : layers) {
        layer = {{1, 1, 1}, 1};
    }
    NacreMaterial good = nacreDefaultMaterial();
    good.layers = layers;
    good.layerCount = 1;
    struct Case {
        std::function<void(NacreMaterial&)> change;
        NacreResult result;
        const char* text;
    };
    NacreLayer badVariance{{1, 1, 1}, nan};
    NacreLayer negative{{1, 1, 1}, -1};
    NacreLayer nothing{{0, 0, 0}, 1};
    const Case cases[] = {
        {[](auto& m) { m.layerCount = 33; }, NACRE_ERROR_LIMIT_EXCEEDED, "layerCount of material 2 is 33"},
        {[](auto& m) { m.layers = nullptr; }, NACRE_ERROR_INVALID_ARGUMENT, "layers of material 2 is null"},
        {[&](auto& m) { m.layers = &badVariance; }, NACRE_ERROR_INVALID_ARGUMENT, "variance is nan"},
        {[&](auto& m) { m.layers = &negative; }, NACRE_ERROR_INVALID_ARGUMENT, "variance is -1"},
        {[&](auto& m) { m.layers = &nothing; }, NACRE_ERROR_INVALID_ARGUMENT, "material 2"},
        {[](auto& m) { m.strength = 2; }, NACRE_ERROR_INVALID_ARGUMENT, "strength is 2"},
        {[](auto& m) { m.scale = -1; }, NACRE_ERROR_INVALID_ARGUMENT, "scale is -1"},
        {[](auto& m) { m.thickness = -1; }, NACRE_ERROR_INVALID_ARGUMENT, "thickness of material 2 is -1"},
        {[](auto& m) { m.layerCount = 0; }, NACRE_ERROR_INVALID_ARGUMENT, "meanFreePath"},
    };
    for (const Case& one : cases) {
        NacreMaterial materials[2] = {good, good};
        one.change(materials[1]);
        expectRefusal(effect, one.result, one.text,
                      [&](VkCommandBuffer) { return nacreSetMaterials(effect.context, 1, 2, materials); });
    }
    const auto set = [&](std::uint32_t first, std::uint32_t count) {
        return [&effect, &good, first, count](VkCommandBuffer) {
            return nacreSetMaterials(effect.context, first, count, &good);
        };
    };
    expectRefusal(effect, NACRE_ERROR_INVALID_ARGUMENT, "firstId is 0", set(0, 1));
    expectRefusal(effect, NACRE_ERROR_LIMIT_EXCEEDED, "firstId is 65535 and count 2", set(65535, 2));
    expectRefusal(effect, NACRE_ERROR_LIMIT_EXCEEDED, "count 4294967295", set(1, 0xffffffffu));
    expectRefusal(effect, NACRE_ERROR_LIMIT_EXCEEDED, "frame is 2",
                  [&](VkCommandBuffer) { return nacreBeginFrame(effect.context, 2); });
}

TEST_F(ArgumentsTest, Context) {
    struct Case {
        std::function<void(NacreContextInfo&)> change;
        NacreResult result;
        const char* text;
    };
    const Case cases[] = {
        {[](auto& i) { i.headerVersion = 1; }, NACRE_ERROR_VERSION_MISMATCH, "headerVersion is 0x1"},
        {[](auto& i) { i.device = VK_NULL_HANDLE; }, NACRE_ERROR_INVALID_ARGUMENT, "NacreContextInfo::device is null"},
        {[](auto& i) { i.getInstanceProcAddr = nullptr; }, NACRE_ERROR_INVALID_ARGUMENT, "getInstanceProcAddr is null"},
        {[](auto& i) {
             i.maxExtent = {0, 16};
         },
         NACRE_ERROR_INVALID_ARGUMENT, "maxExtent is 0x16"},
        {[](auto& i) {
             i.maxExtent = {100000, 16};
         },
         NACRE_ERROR_LIMIT_EXCEEDED, "maxExtent is 100000x16"},
        {[](auto& i) { i.framesInFlight = 9; }, NACRE_ERROR_LIMIT_EXCEEDED, "framesInFlight is 9"},
        {[](auto& i) { i.recordsPerFrame = 65; }, NACRE_ERROR_LIMIT_EXCEEDED, "recordsPerFrame is 65"},
        {[](auto& i) { i.maxMaterials = 65536; }, NACRE_ERROR_LIMIT_EXCEEDED, "maxMaterials is 65536"},
        {[](auto& i) { i.maxLights = 1025; }, NACRE_ERROR_LIMIT_EXCEEDED, "maxLights is 1025"},
        {[](auto& i) { i.materialIdMask = 65536; }, NACRE_ERROR_INVALID_ARGUMENT,
         "materialIdMask is 65536, must be in [0, 65535]"},
        {[](auto& i) { i.materialIdShift = 16; }, NACRE_ERROR_INVALID_ARGUMENT, "materialIdShift is 16"},
        {[](auto& i) { i.normalEncoding = static_cast<NacreNormalEncoding>(3); }, NACRE_ERROR_INVALID_ARGUMENT,
         "normalEncoding is 3"},
        {[](auto& i) { i.normalSpace = static_cast<NacreNormalSpace>(2); }, NACRE_ERROR_INVALID_ARGUMENT,
         "normalSpace is 2"},
        {[](auto& i) { i.techniques = 0x80000000u; }, NACRE_ERROR_INVALID_ARGUMENT, "techniques is 0x80000000"},
    };
    for (const Case& one : cases) {
        NacreContextInfo wrong = info();
        std::string message;
        wrong.userData = &message;
        wrong.messageCallback = [](NacreSeverity, const char* text, void* user) {
            *static_cast<std::string*>(user) = text;
        };
        one.change(wrong);
        NacreContext context = nullptr;
        EXPECT_STREQ(nacreResultString(nacreCreateContext(&wrong, &context)), nacreResultString(one.result));
        EXPECT_NE(message.find(one.text), std::string::npos) << message;
        EXPECT_EQ(context, nullptr);
    }
    EXPECT_EQ(nacreCreateContext(nullptr, nullptr), NACRE_ERROR_INVALID_ARGUMENT);
    nacreDestroyContext(nullptr);
}

TEST_F(ArgumentsTest, ImageRequirementsNameEverySlot) {
    for (int slot = 0; slot < NACRE_IMAGE_SLOT_COUNT; ++slot) {
        NacreImageRequirements requirements{};
        ASSERT_EQ(nacreGetImageRequirements(static_cast<NacreImageSlot>(slot), &requirements), NACRE_SUCCESS);
        EXPECT_NE(requirements.name, nullptr);
        EXPECT_GT(requirements.formatCount, 0u);
        EXPECT_NE(requirements.usage, 0u);
    }
    NacreImageRequirements requirements{};
    EXPECT_EQ(nacreGetImageRequirements(NACRE_IMAGE_SLOT_COUNT, &requirements), NACRE_ERROR_INVALID_ARGUMENT);
}

} // namespace
