// Everything a context owns, and the border between exceptions and result codes.
#pragma once

#include "contract/failure.hpp"
#include "technique.hpp"
#include "vulkan/material_table.hpp"
#include "vulkan/memory_layout.hpp"
#include "vulkan/objects.hpp"

#include <new>
#include <optional>
#include <vector>

namespace nacre::effect {

/// Descriptors and uniform memory of one call in one frame.
struct Record {
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkDescriptorBufferInfo parameters{};
    VkDescriptorBufferInfo lights{}; ///< transmit
    std::byte* mappedParameters = nullptr;
    std::byte* mappedLights = nullptr;
};

/// The calls of one kind (scatter or transmit) in one frame.
struct Records {
    std::vector<Record> records;
    std::uint32_t used = 0;
};

struct Frame {
    Records scatter;
    Records transmit;
};

/// Set layout, pipeline layout and the pipelines of one kind.
struct Programs {
    Owned<VkDescriptorSetLayout> setLayout;
    Owned<VkPipelineLayout> layout;
    IntermediateSet intermediates = 0;
};

/// The image or buffer of an intermediate; both empty when no enabled technique uses it.
struct IntermediateResource {
    Image image;
    Buffer buffer;
    VkDeviceSize bytes() const { return image.requirements.size + buffer.requirements.size; }
};

/// By the number of the intermediate.
using IntermediateResources = std::array<IntermediateResource, maxIntermediates>;

/// A pass's pipelines by Variant; null where the pass lacks one of the constants.
using PassPipelines = std::array<Owned<VkPipeline>, variantCount>;

struct Context {
    Device device;
    NacreMessageCallback messageCallback = nullptr;
    void* userData = nullptr;
    VkExtent2D maxExtent{};
    std::uint32_t maxLights = 0;
    std::array<bool, techniqueCount> enabled{};
    bool shaderFloat16 = false; ///< NacreContextInfo::shaderFloat16

    Programs scatter;
    Programs transmit;
    std::array<std::vector<PassPipelines>, techniqueCount> pipelines; ///< of the passes, then of materialPasses
    std::vector<Owned<VkPipeline>> bakedThesis; ///< the thesis's materialPasses; empty = not baked
    std::uint32_t bakedThesisRadius = 0;
    NacreMemory givenMemory{};                ///< the caller's, for the intermediates
    Owned<VkDeviceMemory> intermediateMemory; ///< else this
    IntermediateResources intermediates;
    Owned<VkDeviceMemory> hostMemory;       ///< of materials and uniforms, unless the caller gave it
    std::optional<MaterialTable> materials; ///< made once the device is known
    Buffer uniforms;
    Owned<VkDescriptorPool> pool;
    std::vector<Frame> frames;
    std::optional<std::uint32_t> frame; ///< last given to nacreBeginFrame
};

/// Runs `body`; what it throws becomes a result code and a message.
template <typename Body> NacreResult guard(NacreMessageCallback callback, void* userData, Body&& body) noexcept {
    const auto report = [&](NacreResult result, const char* message) {
        if (callback) {
            callback(NACRE_SEVERITY_ERROR, message, userData);
        }
        return result;
    };
    try {
        body();
        return NACRE_SUCCESS;
    } catch (const Failure& failure) {
        return report(failure.result, failure.what());
    } catch (const std::bad_alloc&) {
        return report(NACRE_ERROR_OUT_OF_MEMORY, "out of host memory");
    } catch (const std::exception& exception) {
        return report(NACRE_ERROR_INVALID_ARGUMENT, exception.what());
    }
}

/// Creates layouts and pipelines (programs.cpp).
void createPrograms(Context& context, VkPipelineCache cache);
/// Compiles a pass; constants: null = those of the SPIR-V (programs.cpp).
Owned<VkPipeline> createPipeline(const Device& device, VkPipelineLayout layout, const Pass& pass, VkPipelineCache cache,
                                 const VkSpecializationInfo* constants);
/// The intermediates of the enabled techniques for an extent, without memory
/// (programs.cpp).
IntermediateResources createIntermediates(const Context& context, VkExtent2D extent);
/// Where they shall lie; they have to stay where they are (programs.cpp).
MemoryLayout layOut(const Context& context, IntermediateResources& resources);
/// The uniform buffer of all frames, without memory (frames.cpp).
Buffer createUniforms(const Context& context, std::uint32_t frames, std::uint32_t recordsPerFrame);
/// Descriptor sets of all frames, and each one's part of the uniform buffer
/// (frames.cpp).
void createFrames(Context& context, std::uint32_t frames, std::uint32_t recordsPerFrame);
/// The next unused record of a kind; throws when the frame is not the one last begun or has none left.
Record& nextRecord(Context& context, std::uint32_t frame, Records Frame::*kind, const char* info);

/// The index in `techniques` of a technique the context is made for; throws a Failure naming `field` (scatter.cpp).
std::size_t scatterTechniqueIndex(const Context& context, NacreTechnique technique, const char* field);
/// Of that technique or, in its place, of the one that these materials choose (NacreMaterial::secondSurfaces).
std::size_t chosenTechniqueIndex(const Context& context, std::size_t asked, const MaterialTable::Summary& materials);

} // namespace nacre::effect

struct NacreContext_T : nacre::effect::Context {};
