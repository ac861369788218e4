// Ids, normals and masks as engines have them give the picture that the plainest images give; a scissor gives the part
// of it; compose gives its sum.
#include "tests/gpu/support/effect.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr std::uint32_t side = 24;
constexpr VkExtent2D extent{side, side};

/// Camera turned about y and x, so that view and world space differ.
void turn(NacreView& view) {
    const double a = 0.7, b = -0.4;
    const double m[3][3] = {{std::cos(a), 0, std::sin(a)},
                            {std::sin(b) * std::sin(a), std::cos(b), -std::sin(b) * std::cos(a)},
                            {-std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a)}};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            view.viewFromWorld[4 * column + row] = static_cast<float>(m[row][column]);
        }
    }
}

Float4 rotated(const NacreView& view, const Float4& v, bool toWorld) {
    Float4 result{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            result[i] += v[j] * view.viewFromWorld[toWorld ? 4 * i + j : 4 * j + i];
        }
    }
    return result;
}

/// The formula of NACRE_NORMAL_OCTAHEDRAL.
std::array<float, 2> octahedral(const Float4& n) {
    const float sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    const float x = n[0] / sum, y = n[1] / sum;
    if (n[2] >= 0) {
        return {x, y};
    }
    return {(1 - std::abs(y)) * (x < 0 ? -1.0f : 1.0f), (1 - std::abs(x)) * (y < 0 ? -1.0f : 1.0f)};
}

class EncodingsTest : public GpuTest {
protected:
    EncodingsTest() {
        input_ = ScatterInput::plane(side, side, Projection::perspective(side, side, 24), 30);
        turn(input_.view);
        for (std::uint32_t i = 0; i < side * side; ++i) {
            const std::uint32_t x = i % side, y = i / side;
            const float light = x / 3 % 2 == 0 ? 1.0f : 0.1f;
            input_.irradiance[i] = {light, light, light, 1};
            input_.materialId[i] = static_cast<std::uint16_t>(y < 4 ? 0 : x < 12 ? 1 : 2);
            input_.depth[i] = 30 + 0.2f * static_cast<float>(y);
            // All around, in view space; those that look away are silhouettes' and interpolation's.
            const double turnX = 0.13 * (x - 12.0), turnY = 0.13 * (y - 12.0);
            inView_.push_back({static_cast<float>(std::sin(turnX)),
                               static_cast<float>(std::cos(turnX) * std::sin(turnY)),
                               static_cast<float>(std::cos(turnX) * std::cos(turnY)), 0});
            input_.normal.push_back(rotated(input_.view, inView_.back(), true));
        }
    }
    NacreContextInfo contextInfo() const {
        NacreContextInfo info = gpu.contextInfo(extent);
        info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        return info;
    }
    struct Pictures {
        std::vector<Float4> scattered, transmitted, composed;
    };
    using Change = std::function<void(NacreScatterInfo&)>;
    /// All three calls; `change` may give other images, which transmit and compose then have, too.
    Pictures render(const NacreContextInfo& info, NacreTechnique technique, const Change& change = {}) {
        Effect effect(gpu, info);
        return render(effect, technique, change);
    }
    Pictures render(Effect& effect, NacreTechnique technique, const Change& change = {}) {
        std::vector<NacreLayer> layers[2];
        NacreMaterial materials[] = {toNacre(marble(), layers[0]), toNacre(skin(), layers[1])};
        materials[0].thickness = 1;
        materials[1].thickness = 0.5f;
        EXPECT_EQ(nacreSetMaterials(effect.context, 1, 2, materials), NACRE_SUCCESS) << effect.messages.back();
        ScatterImages images(gpu, input_);
        const GpuImage transmitted = gpu.createImage({.extent = extent});
        const GpuImage scattered = gpu.createImage({.extent = extent});
        images.info.scattered = scattered.nacre();
        images.info.technique = technique;
        if (change) {
            change(images.info);
        }
        NacreLight light{};
        light.shadowMap = NACRE_NO_SHADOW_MAP;
        light.direction[0] = light.irradiance[0] = light.irradiance[1] = light.irradiance[2] = 1;
        NacreTransmitInfo transmit = images.transmitInfo({&light, 1});
        transmit.normalScale = images.info.normalScale;
        transmit.normalBias = images.info.normalBias;
        transmit.transmitted = transmitted.nacre();
        NacreComposeInfo compose{};
        compose.renderArea = images.info.view.scissor;
        compose.materialId = images.info.materialId;
        compose.strength = images.info.strength;
        compose.scattered = scattered.nacre();
        compose.transmitted = transmitted.nacre();
        compose.composed = images.scattered.nacre();
        EXPECT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
        gpu.run([&](VkCommandBuffer commandBuffer) {
            EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &images.info), NACRE_SUCCESS)
                << effect.messages.back();
            EXPECT_EQ(nacreCmdTransmit(effect.context, commandBuffer, &transmit), NACRE_SUCCESS)
                << effect.messages.back();
            VkMemoryBarrier written{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
            written.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
            written.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
            vkCmdPipelineBarrier(commandBuffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                 VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &written, 0, nullptr, 0, nullptr);
            EXPECT_EQ(nacreCmdCompose(effect.context, commandBuffer, &compose), NACRE_SUCCESS)
                << effect.messages.back();
        });
        return {gpu.download<Float4>(scattered), gpu.download<Float4>(transmitted),
                gpu.download<Float4>(images.scattered)};
    }
    static void expectSame(const Pictures& a, const Pictures& b, float tolerance, const std::string& what) {
        double most = 0;
        for (std::size_t i = 0; i < a.scattered.size(); ++i) {
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(a.scattered[i][channel], b.scattered[i][channel], tolerance) << what << ", pixel " << i;
                ASSERT_NEAR(a.transmitted[i][channel], b.transmitted[i][channel], tolerance) << what << ", pixel " << i;
                ASSERT_NEAR(a.composed[i][channel], b.composed[i][channel], tolerance) << what << ", pixel " << i;
            }
            most = std::max<double>(most, b.transmitted[i][0]);
        }
        EXPECT_GT(most, 0.05) << "some light comes through";
    }

    ScatterInput input_;
    std::vector<Float4> inView_;
};

TEST_F(EncodingsTest, IdsOfStencilsAndChannels) {
    const Pictures plain = render(contextInfo(), NACRE_TECHNIQUE_SEPARABLE);
    NacreContextInfo masked = contextInfo();
    masked.materialIdMask = 0x0c;
    masked.materialIdShift = 2;
    std::vector<std::uint8_t> bits(side * side);
    std::vector<std::array<std::uint8_t, 4>> channels(side * side);
    for (std::uint32_t i = 0; i < side * side; ++i) { // others have the other bits
        bits[i] = static_cast<std::uint8_t>(input_.materialId[i] << 2 | (i * 7 % 16) << 4 | i % 3);
        channels[i] = {200, 1, 2, bits[i]};
    }
    GpuImage stencil = gpu.createImage({.format = VK_FORMAT_S8_UINT,
                                        .extent = extent,
                                        .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                        .layout = VK_IMAGE_LAYOUT_STENCIL_READ_ONLY_OPTIMAL});
    gpu.upload(stencil, bits);
    GpuImage alpha = gpu.createImage({.format = VK_FORMAT_R8G8B8A8_UINT,
                                      .extent = extent,
                                      .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                      .components = {.r = VK_COMPONENT_SWIZZLE_A}});
    gpu.upload(alpha, channels);
    Effect effect(gpu, masked);
    for (const GpuImage* image : {&stencil, &alpha}) {
        expectSame(render(effect, NACRE_TECHNIQUE_SEPARABLE,
                          [&](NacreScatterInfo& info) { info.materialId = image->nacre(); }),
                   plain, 0, "VkFormat " + std::to_string(image->format));
    }
    const NacreMaterial material = nacreDefaultMaterial();
    EXPECT_EQ(nacreSetMaterials(effect.context, 4, 1, &material), NACRE_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(effect.messages.back().find("no pixel can have id 4, NacreContextInfo::materialIdMask is 12"),
              std::string::npos)
        << effect.messages.back();
}

TEST_F(EncodingsTest, OneMaterialNeedsNoIds) {
    for (std::uint16_t& id : input_.materialId) {
        id = std::min<std::uint16_t>(id, 1);
    }
    NacreContextInfo info = contextInfo();
    info.techniques = 1u << NACRE_TECHNIQUE_BANK;
    NacreContextInfo without = info;
    without.noMaterialIds = VK_TRUE;
    for (const std::uint16_t id : input_.materialId) {
        input_.strength.push_back(id != 0 ? 0.75f : 0.0f);
    }
    Effect effect(gpu, without);
    expectSame(render(effect, NACRE_TECHNIQUE_BANK, [](NacreScatterInfo& scatter) { scatter.materialId = {}; }),
               render(info, NACRE_TECHNIQUE_BANK), 0, "bank");
    ScatterImages images(gpu, input_);
    ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
    gpu.run([&](VkCommandBuffer commandBuffer) {
        EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &images.info), NACRE_ERROR_INVALID_ARGUMENT);
    });
    EXPECT_NE(effect.messages.back().find("NacreScatterInfo::materialId.view is given, but"), std::string::npos);
}

TEST_F(EncodingsTest, NormalsOfEveryKind) {
    constexpr NacreTechnique technique = NACRE_TECHNIQUE_BRUTE; // which reads them
    NacreContextInfo brute = contextInfo();
    brute.techniques = 1u << technique;
    const Pictures plain = render(brute, technique);
    for (const NacreNormalSpace space : {NACRE_NORMAL_WORLD, NACRE_NORMAL_VIEW}) {
        NacreContextInfo info = brute;
        info.normalSpace = space;
        const std::vector<Float4>& normals = space == NACRE_NORMAL_VIEW ? inView_ : input_.normal;
        GpuImage vectors = gpu.createImage({.extent = extent});
        gpu.upload(vectors, normals);
        expectSame(render(info, technique, [&](NacreScatterInfo& scatter) { scatter.normal = vectors.nacre(); }), plain,
                   1e-5f, "three channels");
        info.normalEncoding = NACRE_NORMAL_OCTAHEDRAL;
        std::vector<std::array<float, 2>> floats;
        std::vector<std::array<std::int16_t, 2>> numbers;
        std::vector<std::array<std::uint16_t, 2>> unsignedNumbers;
        for (const Float4& normal : normals) {
            const std::array<float, 2> oct = octahedral(normal);
            floats.push_back(oct);
            numbers.push_back({static_cast<std::int16_t>(std::lround(oct[0] * 32767)),
                               static_cast<std::int16_t>(std::lround(oct[1] * 32767))});
            unsignedNumbers.push_back({static_cast<std::uint16_t>(std::lround((oct[0] + 1) * 32767.5f)),
                                       static_cast<std::uint16_t>(std::lround((oct[1] + 1) * 32767.5f))});
        }
        Effect effect(gpu, info);
        const auto expectFormat = [&](VkFormat format, const auto& texels, float scale, float bias) {
            GpuImage image = gpu.createImage({.format = format, .extent = extent, .usage = VK_IMAGE_USAGE_SAMPLED_BIT});
            gpu.upload(image, texels);
            expectSame(render(effect, technique,
                              [&](NacreScatterInfo& scatter) {
                                  scatter.normal = image.nacre();
                                  scatter.normalScale = scale;
                                  scatter.normalBias = bias;
                              }),
                       plain, 1e-3f, "VkFormat " + std::to_string(format));
        };
        expectFormat(VK_FORMAT_R32G32_SFLOAT, floats, 1, 0);
        expectFormat(VK_FORMAT_R16G16_SNORM, numbers, 1, 0);
        expectFormat(VK_FORMAT_R16G16_UNORM, unsignedNumbers, 2, -1);
    }
    Effect effect(gpu, contextInfo());
    ScatterImages images(gpu, input_);
    images.info.technique = NACRE_TECHNIQUE_SEPARABLE;
    images.info.normal.format = VK_FORMAT_R16G16_SNORM;
    ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
    gpu.run([&](VkCommandBuffer commandBuffer) {
        EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &images.info), NACRE_ERROR_UNSUPPORTED_FORMAT);
    });
    EXPECT_NE(effect.messages.back().find("normal.format is VK_FORMAT_R16G16_SNORM, which has two channels"),
              std::string::npos);
}

TEST_F(EncodingsTest, ScissorGivesThePartOfThePicture) {
    const Pictures whole = render(contextInfo(), NACRE_TECHNIQUE_SEPARABLE);
    constexpr VkRect2D scissor{{3, 5}, {19, 17}};
    constexpr std::uint32_t reach = 6; // px of the materials here
    NacreContextInfo info = contextInfo();
    info.maxExtent = scissor.extent;
    const auto inside = [](std::uint32_t i, std::uint32_t margin) {
        const std::uint32_t x = i % side - 3, y = i / side - 5;
        return x >= margin && y >= margin && x < 19 - margin && y < 17 - margin;
    };
    const Pictures part =
        render(info, NACRE_TECHNIQUE_SEPARABLE, [&](NacreScatterInfo& scatter) { scatter.view.scissor = scissor; });
    int compared = 0;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        if (inside(i, 0)) {
            ASSERT_NEAR(part.transmitted[i][0], whole.transmitted[i][0], 1e-6f);
        }
        if (inside(i, reach)) {
            ++compared;
            ASSERT_NEAR(part.scattered[i][0], whole.scattered[i][0], 1e-3f) << i % side << ", " << i / side;
            ASSERT_NEAR(part.composed[i][0], whole.composed[i][0], 1e-3f);
        }
    }
    EXPECT_GT(compared, 30);
    Effect effect(gpu, contextInfo());
    ScatterImages images(gpu, input_);
    images.info.technique = NACRE_TECHNIQUE_SEPARABLE;
    images.info.view.scissor = {{10, 10}, {15, 2}};
    ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
    gpu.run([&](VkCommandBuffer commandBuffer) {
        EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &images.info), NACRE_ERROR_INVALID_ARGUMENT);
    });
    EXPECT_NE(
        effect.messages.back().find("view.scissor is 15x2 at 10,10, must lie within the render area, 24x24 at 0,0"),
        std::string::npos)
        << effect.messages.back();
}

TEST_F(EncodingsTest, ComposedIsTheSum) {
    const Pictures pictures = render(contextInfo(), NACRE_TECHNIQUE_SEPARABLE);
    for (std::uint32_t i = 0; i < side * side; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const double sum = (pictures.scattered[i][channel] + pictures.transmitted[i][channel]) / 3.14159265358979;
            ASSERT_NEAR(pictures.composed[i][channel], input_.materialId[i] != 0 ? sum : 0, 1e-6);
        }
    }
}

/// Albedo, and the share of a wall's light that stays on this side.
TEST_F(EncodingsTest, ComposesAlbedoAndWalls) {
    Effect effect(gpu, contextInfo());
    std::vector<NacreLayer> layers[2];
    NacreMaterial materials[] = {toNacre(marble(), layers[0]), toNacre(skin(), layers[1])};
    materials[1].translucency = 0.3f;
    materials[1].thinWall = VK_TRUE;
    ASSERT_EQ(nacreSetMaterials(effect.context, 1, 2, materials), NACRE_SUCCESS);
    input_.albedo.assign(side * side, {0.5f, 0.25f, 1, 1});
    const ScatterImages images(gpu, input_);
    GpuImage transmitted = gpu.createImage({.extent = extent});
    gpu.upload(transmitted, std::vector<Float4>(side * side, Float4{0.2f, 0.4f, 0.6f, 1}));
    NacreComposeInfo info{};
    info.materialId = images.info.materialId;
    info.scattered = images.info.irradiance;
    info.albedo = images.info.albedo;
    info.transmitted = transmitted.nacre();
    info.composed = images.scattered.nacre();
    for (const VkBool32 hasAlbedo : {VK_FALSE, VK_TRUE}) {
        info.scatteredHasAlbedo = hasAlbedo;
        ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
        gpu.run([&](VkCommandBuffer commandBuffer) {
            EXPECT_EQ(nacreCmdCompose(effect.context, commandBuffer, &info), NACRE_SUCCESS) << effect.messages.back();
        });
        const auto composed = gpu.download<Float4>(images.scattered);
        for (std::uint32_t i = 0; i < side * side; ++i) {
            const double kept = input_.materialId[i] == 2 ? 0.7 : 1;
            const double scattered = kept * input_.irradiance[i][1] * (hasAlbedo ? 1 : 0.25);
            const double expected = input_.materialId[i] == 0 ? 0 : (scattered + 0.25 * 0.4) / 3.14159265358979;
            ASSERT_NEAR(composed[i][1], expected, 1e-6);
            ASSERT_EQ(composed[i][3], 0);
        }
    }
    info.composed = transmitted.nacre();
    gpu.run([&](VkCommandBuffer commandBuffer) {
        EXPECT_EQ(nacreCmdCompose(effect.context, commandBuffer, &info), NACRE_ERROR_INVALID_ARGUMENT);
    });
    EXPECT_NE(effect.messages.back().find("composed.view is that of an input"), std::string::npos);
}

TEST_F(EncodingsTest, PresetsAreSetByName) {
    Effect effect(gpu, contextInfo());
    std::uint32_t count = 0;
    ASSERT_EQ(nacreGetPresets(&count, nullptr), NACRE_SUCCESS);
    std::vector<const char*> names(count);
    ASSERT_EQ(nacreGetPresets(&count, names.data()), NACRE_SUCCESS);
    EXPECT_GE(count, 10u);
    for (std::uint32_t i = 0; i < count; ++i) {
        EXPECT_EQ(nacreSetPreset(effect.context, i + 1, names[i]), NACRE_SUCCESS) << effect.messages.back();
    }
    EXPECT_EQ(nacreSetPreset(effect.context, 1, "skim"), NACRE_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(effect.messages.back().find("name is \"skim\", must be one of skin, "), std::string::npos);
    EXPECT_EQ(nacreSetPreset(effect.context, 0, "skin"), NACRE_ERROR_INVALID_ARGUMENT);
}

/// An instance of Vulkan 1.0, whose devices lack what the effect calls.
TEST_F(EncodingsTest, OldInstancesAreTold) {
    VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    VkInstance instance = VK_NULL_HANDLE;
    ASSERT_EQ(vkCreateInstance(&instanceInfo, nullptr, &instance), VK_SUCCESS);
    std::uint32_t count = 1;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    ASSERT_GE(vkEnumeratePhysicalDevices(instance, &count, &physicalDevice), VK_SUCCESS);
    const float priority = 1;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    deviceInfo.queueCreateInfoCount = 1;
    deviceInfo.pQueueCreateInfos = &queueInfo;
    VkDevice device = VK_NULL_HANDLE;
    ASSERT_EQ(vkCreateDevice(physicalDevice, &deviceInfo, nullptr, &device), VK_SUCCESS);
    NacreContextInfo info = contextInfo();
    info.instance = instance;
    info.physicalDevice = physicalDevice;
    info.device = device;
    try {
        Effect effect(gpu, info);
        ADD_FAILURE() << "a context was made";
    } catch (const std::runtime_error& error) {
        std::printf("%s\n", error.what());
        EXPECT_NE(std::string(error.what()).find("1.2"), std::string::npos) << error.what();
    }
    vkDestroyDevice(device, nullptr);
    vkDestroyInstance(instance, nullptr);
}

TEST_F(EncodingsTest, ForgottenFeaturesAreTold) {
    NacreContextInfo info = contextInfo();
    VkPhysicalDeviceFeatures features{};
    info.enabledFeatures = &features;
    try {
        Effect effect(gpu, info);
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("enabledFeatures lacks shaderStorageImageWriteWithoutFormat"),
                  std::string::npos)
            << error.what();
    }
}

} // namespace
