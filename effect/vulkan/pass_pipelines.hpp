// Set layouts and pipelines, all of which follow from the techniques' passes.
#pragma once

#include "technique.hpp"
#include "vulkan/objects.hpp"

#include <vector>

namespace nacre::effect {

struct Context;

/// What the calls of one kind (scatter or transmit) bind.
struct CallLayout {
    Owned<VkDescriptorSetLayout> setLayout;
    Owned<VkPipelineLayout> layout;
    IntermediateSet intermediates = 0;
};

/// A pass's pipelines by Variant; null where the pass lacks one of the constants.
using PassPipelines = std::array<Owned<VkPipeline>, variantCount>;

/// Of every technique: its passes', then its materialPasses'.
using TechniquePipelines = std::array<std::vector<PassPipelines>, techniqueCount>;

/// Creates the layouts of both kinds.
void createLayouts(Context& context);
/// The pipelines of the enabled techniques; their layouts exist.
TechniquePipelines createPipelines(const Context& context, VkPipelineCache cache);
/// A pass's SPIR-V as it is now: its own or, in a developer build, that of its file, which `storage` keeps
/// (spirv_embedded.cpp, spirv_of_files.cpp).
std::span<const std::uint32_t> currentSpirv(const Pass& pass, std::vector<std::uint32_t>& storage);
/// Compiles a pass; constants: null = those of the SPIR-V.
Owned<VkPipeline> createPipeline(const Device& device, VkPipelineLayout layout, const Pass& pass, VkPipelineCache cache,
                                 const VkSpecializationInfo* constants);

} // namespace nacre::effect
