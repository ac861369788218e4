// Set layouts and pipelines, all of which follow from the techniques' passes.
#pragma once

#include "technique.hpp"
#include "vulkan/objects.hpp"

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

/// Creates the layouts of both kinds and the pipelines of the enabled techniques.
void createPipelines(Context& context, VkPipelineCache cache);
/// Compiles a pass; constants: null = those of the SPIR-V.
Owned<VkPipeline> createPipeline(const Device& device, VkPipelineLayout layout, const Pass& pass, VkPipelineCache cache,
                                 const VkSpecializationInfo* constants);

} // namespace nacre::effect
