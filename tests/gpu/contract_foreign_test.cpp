// nacre_passes.h in an engine whose abstraction is not like the library's own (support/tracked_device.hpp): bank and
// transmit run on it give the very picture of nacreCmdScatter and nacreCmdTransmit.
#include "nacre/nacre_passes.h"
#include "tests/gpu/support/effect.hpp"
#include "tests/gpu/support/tracked_device.hpp"

#include <algorithm>
#include <stdexcept>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr VkExtent2D extent{70, 38}; // no power of two, as elsewhere

void check(NacreResult result) {
    if (result != NACRE_SUCCESS) {
        throw std::runtime_error(nacreResultString(result));
    }
}

using ImagesBySlot = std::map<NacreImageSlot, std::vector<TrackedDevice::Handle>>;

/// A technique on the engine's device, for materials 1, 2, …
class ForeignEffect {
public:
    ForeignEffect(TrackedDevice& device, NacreTechnique technique, std::span<const NacreMaterial> materials,
                  std::uint32_t lightElements)
        : device_(device), technique_(technique), materials_(materials) {
        std::uint32_t count = 0;
        check(nacreGetBindings(technique, extent, &count, nullptr));
        bindings_.resize(count);
        check(nacreGetBindings(technique, extent, &count, bindings_.data()));
        for (const NacreBinding& binding : bindings_) {
            slots_.push_back({binding.binding, binding.type, binding.count});
            if (binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
                binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
                const bool isLights = binding.name == std::string("lights");
                const std::size_t elements = isLights ? lightElements : materials.size() + 1;
                buffers_[binding.name] =
                    device.createBuffer(binding.head + binding.stride * elements,
                                        binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                            ? VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT
                                            : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
                made_[binding.binding] = buffers_[binding.name];
            } else if (binding.intermediate) {
                made_[binding.binding] = device.createImage(binding.format, binding.extent, binding.array);
            }
        }
        setMaterials();
    }

    void scatter(const NacreScatterInfo& info, const ImagesBySlot& images) {
        const std::uint32_t given = bitsOf(images) & (1u << NACRE_IMAGE_NORMAL | 1u << NACRE_IMAGE_STRENGTH |
                                                      1u << NACRE_IMAGE_SCALE | 1u << NACRE_IMAGE_ALBEDO);
        const std::span<std::byte> parameters = contents("parameters");
        check(nacreFillScatterParameters(&info, given, nullptr, parameters.size(), parameters.data()));
        run(images, nacreGetScatterConstants(given, static_cast<std::uint32_t>(materials_.size()), materials_.data()));
    }
    void transmit(const NacreTransmitInfo& info, const ImagesBySlot& images) {
        const std::uint32_t given = bitsOf(images) & (1u << NACRE_IMAGE_STRENGTH | 1u << NACRE_IMAGE_SCALE |
                                                      1u << NACRE_IMAGE_THICKNESS | 1u << NACRE_IMAGE_THICKNESS_OUT);
        const std::span<std::byte> parameters = contents("parameters");
        check(nacreFillTransmitParameters(&info, given, nullptr, parameters.size(), parameters.data()));
        const std::span<std::byte> lights = contents("lights");
        check(nacreFillLights(&info, nullptr, lights.size(), lights.data()));
        run(images, nacreGetTransmitConstants(given, &info));
    }

private:
    std::span<std::byte> contents(const char* name) const { return device_.contents(buffers_.at(name)); }
    static std::uint32_t bitsOf(const ImagesBySlot& images) {
        std::uint32_t bits = 0;
        for (const auto& [slot, handles] : images) {
            bits |= 1u << slot;
        }
        return bits;
    }
    const NacreBinding& bindingOf(const char* name) const {
        return *std::ranges::find_if(bindings_, [&](const NacreBinding& one) { return std::string(name) == one.name; });
    }
    void setMaterials() {
        const NacreBinding& blocks = bindingOf("materials");
        const NacreBinding& tables = bindingOf("tables");
        const std::span<std::byte> to = contents("materials");
        std::ranges::fill(to, std::byte{0});
        for (std::uint32_t slot = 1; slot <= materials_.size(); ++slot) {
            std::memcpy(&to[slot * sizeof(slot)], &slot, sizeof(slot)); // of the id that is as large
            check(nacreFillMaterial(&materials_[slot - 1], nullptr, blocks.stride,
                                    &to[blocks.head + slot * blocks.stride]));
            check(nacreFillTable(technique_, &materials_[slot - 1], nullptr, tables.stride,
                                 &contents("tables")[tables.head + slot * tables.stride]));
        }
    }
    /// What a pass does with each of its bindings. Outputs are written by the passes that bind them.
    std::map<std::uint32_t, TrackedDevice::Bound> boundOf(const NacrePass& pass, const ImagesBySlot& images) const {
        std::map<std::uint32_t, TrackedDevice::Bound> bound;
        for (const NacreBinding& binding : bindings_) {
            TrackedDevice::Bound& one = bound[binding.binding];
            const bool isWritten = (pass.writes >> binding.binding & 1u) != 0;
            one.states = binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER      ? StateUniform
                         : binding.type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE     ? StateSampled
                         : isWritten || binding.image != NACRE_IMAGE_SLOT_COUNT ? StateStorageWrite
                                                                                : StateStorageRead;
            const auto made = made_.find(binding.binding);
            const auto given = images.find(binding.image);
            if (made != made_.end()) {
                one.resources = {made->second};
            } else if (given != images.end()) {
                one.resources = given->second;
            } else {
                one.resources = images.at(binding.image == NACRE_IMAGE_THICKNESS_OUT ? NACRE_IMAGE_TRANSMITTED
                                                                                     : NACRE_IMAGE_NORMAL);
            }
        }
        return bound;
    }
    void run(const ImagesBySlot& images, std::uint32_t constants) {
        std::uint32_t count = 0;
        check(nacreGetPasses(technique_, extent, &count, nullptr));
        std::vector<NacrePass> passes(count);
        check(nacreGetPasses(technique_, extent, &count, passes.data()));
        for (const NacrePass& pass : passes) {
            ASSERT_FALSE(pass.perMaterial);
            TrackedDevice::Dispatch dispatch{.bound = boundOf(pass, images), .groups = pass.groups};
            dispatch.program = &programOf(pass, constants & pass.constants);
            if (pass.indirectBinding != 0) {
                dispatch.indirect = &made_.at(pass.indirectBinding);
                dispatch.indirectOffset = pass.indirectOffset;
            }
            for (std::uint32_t repeat = 0; repeat < pass.repeats; ++repeat) {
                dispatch.pushed = repeat;
                device_.dispatch(dispatch);
            }
        }
    }
    const TrackedDevice::Program& programOf(const NacrePass& pass, std::uint32_t constants) {
        TrackedDevice::Program& program = programs_[{pass.name, constants}];
        if (program.pipeline == VK_NULL_HANDLE) {
            std::map<std::uint32_t, VkBool32> values;
            for (std::uint32_t id = 0; id < 32; ++id) {
                if ((pass.constants >> id & 1u) != 0) {
                    values[id] = constants >> id & 1u;
                }
            }
            program = device_.createProgram({pass.spirv, pass.spirvSize / sizeof(std::uint32_t)}, slots_, values);
        }
        return program;
    }

    TrackedDevice& device_;
    NacreTechnique technique_;
    std::span<const NacreMaterial> materials_;
    std::vector<NacreBinding> bindings_;
    std::vector<TrackedDevice::Slot> slots_;
    std::map<std::string, TrackedDevice::Handle> buffers_;
    std::map<std::uint32_t, TrackedDevice::Handle> made_; ///< buffers and intermediates by binding
    std::map<std::pair<std::string, std::uint32_t>, TrackedDevice::Program> programs_;
};

class ForeignTest : public GpuTest {
protected:
    ForeignTest() {
        const Material both[] = {skin(), burley()};
        for (int i = 0; i < 2; ++i) {
            materials_[i] = toNacre(both[i], layers_[i]);
            materials_[i].exchangeGroups = 1u << i;
        }
        NacreContextInfo info = gpu.contextInfo(extent);
        info.techniques = 1u << NACRE_TECHNIQUE_BANK;
        info.shaderFloat16 = VK_FALSE;
        effect_ = std::make_unique<Effect>(gpu, info);
        EXPECT_EQ(nacreSetMaterials(effect_->context, 1, 2, materials_), NACRE_SUCCESS);
        EXPECT_EQ(nacreBeginFrame(effect_->context, 0), NACRE_SUCCESS);
    }
    /// Two materials and a background, lit in stripes, on a plane that leans away and has a step in it.
    static ScatterInput scene() {
        ScatterInput input = ScatterInput::plane(extent.width, extent.height,
                                                 Projection::perspective(extent.width, extent.height, 600), 300);
        for (std::uint32_t i = 0; i < extent.width * extent.height; ++i) {
            const std::uint32_t x = i % extent.width;
            input.materialId[i] = static_cast<std::uint16_t>(i / extent.width < 4 ? 0 : x < 30 ? 1 : 2);
            input.irradiance[i] = x / 8 % 2 == 0 ? Float4{1, 0.8f, 0.6f, 1} : Float4{0.1f, 0, 0, 1};
            input.depth[i] = 300 + 0.1f * static_cast<float>(x) + (x > 50 ? 40.0f : 0.0f);
            input.scale.push_back(x % 10 < 5 ? 1.0f : 0.6f);
        }
        input.normal.assign(input.depth.size(), {0.196f, 0, 0.981f, 0});
        input.albedo.assign(input.depth.size(), {0.5f, 0.25f, 0.75f, 1});
        return input;
    }
    ImagesBySlot import(const ScatterImages& images) {
        constexpr NacreImageSlot slots[] = {NACRE_IMAGE_IRRADIANCE, NACRE_IMAGE_DEPTH, NACRE_IMAGE_MATERIAL_ID,
                                            NACRE_IMAGE_NORMAL,     NACRE_IMAGE_SCALE, NACRE_IMAGE_ALBEDO};
        ImagesBySlot imported;
        for (std::size_t i = 0; i < images.images.size(); ++i) {
            imported[slots[i]] = {device_.import(images.images[i])};
        }
        return imported;
    }
    /// Two lights in maps of two images, one of hardware depth.
    void makeLights() {
        for (std::uint32_t i = 0; i < 2; ++i) {
            mapImages_[i] = gpu.createImage({.format = VK_FORMAT_R32_SFLOAT, .extent = {17, 17}, .array = true});
            gpu.upload(mapImages_[i], std::vector<float>(17 * 17, i == 0 ? 0.3f : 0.29f));
            maps_[i] = mapImages_[i].nacre();
            NacreLight& light = lights_[i];
            light.kind = NACRE_LIGHT_DIRECTIONAL;
            light.position[2] = -600;
            light.direction[2] = 2;
            light.irradiance[0] = light.irradiance[1] = light.irradiance[2] = 1;
            light.shadowMap = i;
            light.shadowRange = 1000;
            light.shadowClipFromWorld[0] = light.shadowClipFromWorld[5] = 0.01f;
            light.shadowClipFromWorld[15] = 1;
        }
        lights_[1].shadowDepthEncoding = NACRE_DEPTH_HARDWARE; // from z = -600 on over 1000, as the other's
        lights_[1].shadowClipFromWorld[10] = 0.001f;
        lights_[1].shadowClipFromWorld[14] = 0.6f;
    }

    std::vector<NacreLayer> layers_[2];
    NacreMaterial materials_[2];
    std::unique_ptr<Effect> effect_;
    GpuImage mapImages_[2];
    NacreImage maps_[2];
    NacreLight lights_[2]{};
    TrackedDevice device_{gpu};
};

TEST_F(ForeignTest, BankIsThatOfAContext) {
    const ScatterInput input = scene();
    const std::vector<Float4> expected = effect_->scatter(input, NACRE_TECHNIQUE_BANK);
    EXPECT_GT(std::ranges::count_if(expected, [](const Float4& pixel) { return pixel[0] > 0.1f; }), 1000);
    const ScatterImages images(gpu, input);
    ImagesBySlot imported = import(images);
    imported[NACRE_IMAGE_SCATTERED] = {device_.import(images.scattered)};
    ForeignEffect foreign(device_, NACRE_TECHNIQUE_BANK, materials_, 0);
    for (int frame = 0; frame < 2; ++frame) { // the second finds what the first left
        gpu.run([&](VkCommandBuffer commands) {
            device_.begin(commands);
            foreign.scatter(images.info, imported);
        });
        EXPECT_EQ(gpu.download<Float4>(images.scattered), expected) << "frame " << frame;
    }
    EXPECT_GE(device_.barrierCount, 6u) << "every pass reads what the one before it wrote";
}

TEST_F(ForeignTest, TransmitIsThatOfAContext) {
    makeLights();
    const ScatterImages images(gpu, scene());
    GpuImage outputs[2];
    for (GpuImage& output : outputs) {
        output = gpu.createImage({.extent = extent});
    }
    NacreTransmitInfo info = images.transmitInfo(lights_, maps_);
    info.transmitted = outputs[0].nacre();
    gpu.run([&](VkCommandBuffer commands) {
        EXPECT_EQ(nacreCmdTransmit(effect_->context, commands, &info), NACRE_SUCCESS) << effect_->messages.back();
    });
    const std::vector<Float4> expected = gpu.download<Float4>(outputs[0]);
    EXPECT_GT(std::ranges::count_if(expected, [](const Float4& pixel) { return pixel[0] > 0.1f; }), 1000);
    ImagesBySlot imported = import(images);
    imported[NACRE_IMAGE_SHADOW_MAP] = {device_.import(mapImages_[0]), device_.import(mapImages_[1])};
    imported[NACRE_IMAGE_TRANSMITTED] = {device_.import(outputs[1])};
    ForeignEffect foreign(device_, NACRE_TECHNIQUE_TRANSMIT, materials_, nacreGetLightElementCount(&info));
    gpu.run([&](VkCommandBuffer commands) {
        device_.begin(commands);
        foreign.transmit(info, imported);
    });
    EXPECT_EQ(gpu.download<Float4>(outputs[1]), expected);
}

} // namespace
