// The effect without a context (nacre_passes.h): passes dispatched by hand give the very picture of nacreCmdScatter and
// nacreCmdTransmit, and wrong arguments are refused.
#include "nacre/nacre_baselines.h"
#include "tests/gpu/support/effect.hpp"
#include "tests/gpu/support/parts_engine.hpp"

#include <limits>
#include <map>
#include <set>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr VkExtent2D extent{72, 40};
constexpr VkRect2D part{{5, 3}, {50, 33}};
constexpr NacreTechnique scatterTechniques[] = {NACRE_TECHNIQUE_SEPARABLE, NACRE_TECHNIQUE_BRUTE,
                                                NACRE_TECHNIQUE_BANK,      NACRE_TECHNIQUE_BURLEY,
                                                NACRE_TECHNIQUE_THESIS,    NACRE_TECHNIQUE_BANK_SURFACES};

/// Two materials and a background, lit in stripes, on a plane that leans away and has a step in it.
ScatterInput scene(bool everything) {
    ScatterInput input = ScatterInput::plane(extent.width, extent.height,
                                             Projection::perspective(extent.width, extent.height, 600), 300);
    for (std::uint32_t y = 0; y < extent.height; ++y) {
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const std::size_t i = input.index(x, y);
            input.materialId[i] = static_cast<std::uint16_t>(y < 4 ? 0 : x < 30 ? 1 : 2);
            input.irradiance[i] = x / 8 % 2 == 0 ? Float4{1, 0.8f, 0.6f, 1} : Float4{0.1f, 0, 0, 1};
            input.depth[i] = 300 + 0.1f * static_cast<float>(x) + (x > 50 ? 40.0f : 0.0f);
        }
    }
    const std::size_t count = input.depth.size();
    input.normal.assign(count, {0.196f, 0, 0.981f, 0});
    if (everything) {
        input.strength.assign(count, 0.75f);
        input.albedo.assign(count, {0.5f, 0.25f, 0.75f, 1});
        input.view.renderArea = part;
        input.view.clipFromView[8] += 0.3f;
    } else {
        input.normal.clear();
    }
    return input;
}

class PartsTest : public GpuTest {
protected:
    PartsTest() {
        const Material both[] = {skin(), burley()};
        for (int i = 0; i < 2; ++i) {
            materials_[i] = toNacre(both[i], layers_[i]);
            materials_[i].thickness = 4;
        }
        materials_[1].albedoUse = NACRE_ALBEDO_PRE_AND_POST;
        materials_[1].exchangeGroups = 2;
    }
    /// `separate`: light does not cross between the two.
    void setSeparate(bool separate) { materials_[0].exchangeGroups = separate ? 1 : 3; }

    std::vector<NacreLayer> layers_[2];
    NacreMaterial materials_[2];
};

TEST_F(PartsTest, ScatterIsThatOfAContext) {
    Effect effect(gpu, gpu.contextInfo(extent));
    for (const NacreTechnique technique : scatterTechniques) {
        // Larger than the area, so that sizes and strides follow maxExtent.
        PartsEngine engine(gpu, technique, {extent.width + 40, extent.height + 9}, 3);
        for (const int call : {0, 1, 2, 3}) {
            const bool everything = call / 2 != 0;
            setSeparate(call % 2 != 0);
            ASSERT_EQ(nacreSetMaterials(effect.context, 1, 2, materials_), NACRE_SUCCESS);
            engine.setMaterials(materials_);
            const ScatterInput input = scene(everything);
            const std::vector<Float4> expected = effect.scatter(input, technique);
            EXPECT_NE(expected, input.irradiance);
            ScatterImages images(gpu, input);
            images.info.technique = technique;
            gpu.run([&](VkCommandBuffer commandBuffer) { engine.scatter(commandBuffer, images.info); });
            const std::vector<Float4> image = gpu.download<Float4>(images.scattered);
            std::size_t different = 0;
            for (std::uint32_t y = 0; y < extent.height; ++y) {
                for (std::uint32_t x = 0; x < extent.width; ++x) {
                    const bool inside = !everything || (x >= 5 && x < 55 && y >= 3 && y < 36);
                    different += inside && image[input.index(x, y)] != expected[input.index(x, y)] ? 1 : 0;
                }
            }
            EXPECT_EQ(different, 0u) << nacreTechniqueString(technique) << ", call " << call;
        }
    }
}

TEST_F(PartsTest, TransmitIsThatOfAContext) {
    NacreContextInfo contextInfo = gpu.contextInfo(extent);
    contextInfo.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
    Effect effect(gpu, contextInfo);
    ASSERT_EQ(nacreSetMaterials(effect.context, 1, 2, materials_), NACRE_SUCCESS);
    PartsEngine engine(gpu, NACRE_TECHNIQUE_TRANSMIT, extent, 2, 3);
    engine.setMaterials(materials_);
    const ScatterImages images(gpu, scene(true));
    GpuImage mapImages[2];
    NacreImage maps[2];
    for (int i = 0; i < 2; ++i) {
        mapImages[i] = gpu.createImage({.format = VK_FORMAT_R32_SFLOAT, .extent = {16, 16}, .layers = 6});
        gpu.upload(mapImages[i], std::vector<float>(16 * 16 * 6, 0.3f + 0.0005f * static_cast<float>(i)));
        maps[i] = mapImages[i].nacre();
    }
    NacreLight lights[3]{};
    for (int i = 0; i < 3; ++i) {
        NacreLight& light = lights[i];
        light.kind = static_cast<NacreLightKind>(i);
        light.position[2] = -600;
        light.direction[2] = 2;
        light.irradiance[0] = light.irradiance[1] = light.irradiance[2] = 1;
        light.range = 5000;
        light.outerConeAngle = 0.6f;
        light.innerConeAngle = 0.3f;
        light.shadowMap = i == 1 ? NACRE_NO_SHADOW_MAP : 0;
        light.shadowRange = 1000;
        light.shadowClipFromWorld[0] = light.shadowClipFromWorld[5] = 0.01f;
        light.shadowClipFromWorld[15] = 1;
    }
    GpuImage outputs[2][2];
    for (GpuImage(&pair)[2] : outputs) {
        pair[0] = gpu.createImage({.extent = extent});
        pair[1] = gpu.createImage({.format = VK_FORMAT_R32_SFLOAT, .extent = extent});
        gpu.upload(pair[0], std::vector<Float4>(extent.width * extent.height));
        gpu.upload(pair[1], std::vector<float>(extent.width * extent.height));
    }
    std::vector<Float4> before;
    for (const std::uint32_t mapCount : {1u, 2u}) {
        lights[2].shadowMap = mapCount - 1;
        NacreTransmitInfo info = images.transmitInfo(lights, std::span(maps).first(mapCount));
        info.filterRadius = 1;
        ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
        gpu.run([&](VkCommandBuffer commandBuffer) {
            info.transmitted = outputs[0][0].nacre();
            info.thicknessOut = outputs[0][1].nacre();
            EXPECT_EQ(nacreCmdTransmit(effect.context, commandBuffer, &info), NACRE_SUCCESS);
            info.transmitted = outputs[1][0].nacre();
            info.thicknessOut = outputs[1][1].nacre();
            engine.transmit(commandBuffer, info);
        });
        const std::vector<Float4> expected = gpu.download<Float4>(outputs[0][0]);
        float brightest = 0;
        for (const Float4& pixel : expected) {
            brightest = std::max(brightest, pixel[0]);
        }
        EXPECT_GT(brightest, 0.1f);
        EXPECT_NE(expected, before) << "the second map is another";
        EXPECT_EQ(gpu.download<Float4>(outputs[1][0]), expected);
        EXPECT_EQ(gpu.download<float>(outputs[1][1]), gpu.download<float>(outputs[0][1]));
        before = expected;
    }
}

TEST_F(PartsTest, ListsNameWhatAContextHas) {
    Effect effect(gpu, gpu.contextInfo(extent));
    for (const NacreTechnique technique : scatterTechniques) {
        NacreCost cost{};
        ASSERT_EQ(nacreGetScatterCost(effect.context, technique, &cost), NACRE_SUCCESS);
        std::uint32_t count = 0;
        ASSERT_EQ(nacreGetPasses(technique, extent, &count, nullptr), NACRE_SUCCESS);
        std::vector<NacrePass> passes(count);
        ASSERT_EQ(nacreGetPasses(technique, extent, &count, passes.data()), NACRE_SUCCESS);
        std::uint32_t perMaterial = 0;
        for (const NacrePass& pass : passes) {
            perMaterial += pass.perMaterial ? 1 : 0;
            EXPECT_EQ(pass.indirectBinding == 0, pass.groups.width > 0) << pass.name;
            const bool hasHalf = std::string(pass.name) == "nacre bank combine smooth";
            ASSERT_EQ(pass.halfSpirv != nullptr, hasHalf) << pass.name;
            if (hasHalf) {
                EXPECT_STREQ(pass.halfFile, "bank_combine_smooth_half");
                EXPECT_GT(pass.halfSpirvSize, 20u);
                EXPECT_EQ(pass.halfSpirv[0], 0x07230203u); // SPIR-V's magic number
            }
        }
        EXPECT_EQ(perMaterial, cost.dispatchesPerMaterial);
        EXPECT_EQ(count, cost.passCount + (perMaterial > 0 ? perMaterial - 1 : 0));
        ASSERT_EQ(nacreGetBindings(technique, extent, &count, nullptr), NACRE_SUCCESS);
        std::vector<NacreBinding> bindings(count);
        ASSERT_EQ(nacreGetBindings(technique, extent, &count, bindings.data()), NACRE_SUCCESS);
        VkDeviceSize materialBytes = 0;
        for (const NacreBinding& binding : bindings) {
            materialBytes += binding.stride;
        }
        EXPECT_EQ(materialBytes, cost.materialBytes) << nacreTechniqueString(technique);
        --count;
        EXPECT_EQ(nacreGetBindings(technique, extent, &count, bindings.data()), NACRE_ERROR_LIMIT_EXCEEDED);
        EXPECT_EQ(count, bindings.size() - 1);
    }
    // The default is a technique like any other.
    std::uint32_t count = 1;
    NacrePass pass{};
    EXPECT_EQ(nacreGetPasses(NACRE_TECHNIQUE_DEFAULT, extent, &count, &pass), NACRE_ERROR_LIMIT_EXCEEDED);
    EXPECT_STREQ(pass.name, "nacre bank reduce");
    for (const VkExtent2D wrong : {VkExtent2D{0, 4}, VkExtent2D{4, 16385}}) {
        EXPECT_EQ(nacreGetPasses(NACRE_TECHNIQUE_BANK, wrong, &count, nullptr), NACRE_ERROR_INVALID_ARGUMENT);
        EXPECT_EQ(nacreGetBindings(NACRE_TECHNIQUE_BANK, wrong, &count, nullptr), NACRE_ERROR_INVALID_ARGUMENT);
    }
    EXPECT_EQ(nacreGetPasses(static_cast<NacreTechnique>(8), extent, &count, nullptr), NACRE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(nacreGetPasses(NACRE_TECHNIQUE_BANK, extent, nullptr, nullptr), NACRE_ERROR_INVALID_ARGUMENT);
}

TEST_F(PartsTest, WrongArgumentsAreNamedAndWriteNothing) {
    struct Case {
        std::function<NacreResult(const NacreMessages*, void*)> call;
        NacreResult result;
        const char* text;
    };
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr std::size_t size = 32 * 1024;
    const ScatterInput input = scene(true);
    NacreScatterInfo scatter{};
    scatter.view = input.view;
    scatter.depth.extent = scatter.materialId.extent = extent;
    NacreLight light{};
    light.direction[2] = 1;
    light.shadowMap = NACRE_NO_SHADOW_MAP;
    NacreTransmitInfo transmit{};
    transmit.view = input.view;
    transmit.lights = &light;
    transmit.lightCount = 1;
    NacreLayer badLayer{{1, 1, 1}, nan};
    NacreMaterial bad = materials_[0];
    bad.layers = &badLayer;
    bad.layerCount = 1;
    const auto changed = [](auto info, auto change) {
        change(info);
        return info;
    };
    const auto noArea = changed(scatter, [](auto& i) { i.view.renderArea = {}; });
    const NacreBaselineSettings settings{.thesisBakedKernel = VK_TRUE};
    const auto baked = changed(scatter, [&](auto& i) { i.baselines = &settings; });
    const auto badClip = changed(scatter, [](auto& i) { i.view.clipFromView[5] = nan; });
    const auto noDepth = changed(scatter, [](auto& i) { i.depth.extent = {}; });
    const auto badOffset = changed(transmit, [](auto& i) { i.normalOffset = -1; });
    const auto noLights = changed(transmit, [](auto& i) { i.lights = nullptr; });
    const auto none = changed(noLights, [](auto& i) { i.lightCount = 0; });
    EXPECT_EQ(nacreFillLights(&none, nullptr, 0, nullptr), NACRE_SUCCESS);
    NacreLight badLight = light;
    badLight.shadowMap = 0;
    const auto noMap = changed(transmit, [&](auto& i) { i.lights = &badLight; });
    const Case cases[] = {
        {[&](auto* m, void* to) { return nacreFillMaterial(nullptr, m, size, to); }, NACRE_ERROR_INVALID_ARGUMENT,
         "material is null"},
        {[&](auto* m, void* to) { return nacreFillMaterial(&bad, m, size, to); }, NACRE_ERROR_INVALID_ARGUMENT,
         "variance is nan"},
        {[&](auto* m, void* to) { return nacreFillMaterial(&materials_[0], m, 31, to); }, NACRE_ERROR_INVALID_ARGUMENT,
         "size is 31, the block takes 32 bytes"},
        {[&](auto* m, void*) { return nacreFillMaterial(&materials_[0], m, size, nullptr); },
         NACRE_ERROR_INVALID_ARGUMENT, "data is null"},
        {[&](auto* m, void* to) { return nacreFillTable(NACRE_TECHNIQUE_BANK, &bad, m, size, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "variance is nan"},
        {[&](auto* m, void* to) { return nacreFillTable(NACRE_TECHNIQUE_BANK, &materials_[0], m, 100, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "size is 100, the block takes"},
        {[&](auto* m, void* to) {
             return nacreFillTable(static_cast<NacreTechnique>(99), &materials_[0], m, size, to);
         },
         NACRE_ERROR_INVALID_ARGUMENT, "technique is 99"},
        {[&](auto* m, void* to) { return nacreFillScatterParameters(nullptr, 0, m, size, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo is null"},
        {[&](auto* m, void* to) { return nacreFillScatterParameters(&scatter, 0x100, m, size, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "images is 0x100"},
        {[&](auto* m, void* to) { return nacreFillScatterParameters(&noArea, 0, m, size, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::view.renderArea.extent is 0x0"},
        {[&](auto* m, void* to) { return nacreFillScatterParameters(&noDepth, 0, m, size, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::depth.extent is 0x0, the render area reaches to 55x36"},
        {[&](auto* m, void* to) { return nacreFillScatterParameters(&baked, 0, m, size, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreBaselineSettings::thesisBakedKernel is 1"},
        {[&](auto* m, void* to) { return nacreFillScatterParameters(&badClip, 0, m, size, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::view.clipFromView[5] is nan"},
        {[&](auto* m, void* to) { return nacreFillScatterParameters(&scatter, 0, m, 100, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "size is 100"},
        {[&](auto* m, void* to) { return nacreFillTransmitParameters(&badOffset, 0, m, size, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::normalOffset is -1"},
        {[&](auto* m, void* to) { return nacreFillTransmitParameters(&transmit, 1, m, size, to); },
         NACRE_ERROR_INVALID_ARGUMENT, "images is 0x1"},
        {[&](auto* m, void* to) { return nacreFillLights(&noLights, m, size, to); }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights is null"},
        {[&](auto* m, void* to) { return nacreFillLights(&noMap, m, size, to); }, NACRE_ERROR_INVALID_ARGUMENT,
         "NacreTransmitInfo::lights[0].shadowMap is 0"},
        {[&](auto* m, void* to) { return nacreFillLights(&transmit, m, 127, to); }, NACRE_ERROR_INVALID_ARGUMENT,
         "size is 127, the block takes 240 bytes"},
    };
    const std::vector<std::byte> before(size, std::byte{0x5a});
    for (const Case& one : cases) {
        std::vector<std::byte> block = before;
        std::string said;
        const NacreMessages messages{
            [](NacreSeverity, const char* text, void* to) { *static_cast<std::string*>(to) = text; }, &said};
        EXPECT_STREQ(nacreResultString(one.call(&messages, block.data())), nacreResultString(one.result)) << one.text;
        EXPECT_NE(said.find(one.text), std::string::npos) << said;
        EXPECT_EQ(block, before) << one.text;
        EXPECT_EQ(one.call(nullptr, block.data()), one.result) << "silent";
    }
}

/// Techniques share a set layout, so that a binding has one meaning; and each is named and listed once.
TEST(Techniques, AreListedOnceAndAgreeOnBindings) {
    std::uint32_t count = 0;
    ASSERT_EQ(nacreGetTechniques(&count, nullptr), NACRE_SUCCESS);
    std::vector<NacreTechnique> techniques(count);
    ASSERT_EQ(nacreGetTechniques(&count, techniques.data()), NACRE_SUCCESS);
    EXPECT_EQ(techniques.size(), NACRE_TECHNIQUE_COUNT - 1u);
    std::map<std::uint32_t, std::string> meanings;
    std::set<std::string> names{"unknown", nacreTechniqueString(NACRE_TECHNIQUE_DEFAULT)};
    for (const NacreTechnique technique : techniques) {
        EXPECT_TRUE(names.insert(nacreTechniqueString(technique)).second) << technique;
        NacreBinding bindings[32];
        std::uint32_t bindingCount = 32;
        ASSERT_EQ(nacreGetBindings(technique, extent, &bindingCount, bindings), NACRE_SUCCESS);
        for (const NacreBinding& binding : std::span(bindings, bindingCount)) {
            const auto& [number, name] = *meanings.emplace(binding.binding, binding.name).first;
            EXPECT_EQ(name, binding.name) << "binding " << number;
        }
    }
    std::uint32_t few = 2;
    EXPECT_EQ(nacreGetTechniques(&few, techniques.data()), NACRE_ERROR_LIMIT_EXCEEDED);
    EXPECT_EQ(few, 2u);
    EXPECT_EQ(nacreGetTechniques(nullptr, nullptr), NACRE_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(nacreTechniqueString(NACRE_TECHNIQUE_COUNT), "unknown");
}

} // namespace
