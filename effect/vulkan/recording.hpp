// Writes descriptors and records a technique's passes. Allocates nothing.
#pragma once

#include "transmit/transmit_blocks.h"
#include "vulkan/context.hpp"

namespace nacre::effect {

/// Collects the descriptor writes of one set and hands them over at once.
class DescriptorWriter {
public:
    explicit DescriptorWriter(VkDescriptorSet set) : set_(set) {}

    void uniform(std::uint32_t binding, const VkDescriptorBufferInfo& info);
    void storage(std::uint32_t binding, const VkDescriptorBufferInfo& info);
    /// An input; `fallback` (never read) stands in where it is not given.
    void sampled(std::uint32_t binding, const NacreImage& image, const NacreImage& fallback);
    /// An array of inputs; `fallback` (never read) fills it up to `count`.
    void sampledArray(std::uint32_t binding, std::span<const NacreImage> images, std::uint32_t count,
                      const NacreImage& fallback);
    void output(std::uint32_t binding, const NacreImage& image);
    void intermediates(const Context& context, IntermediateSet set);
    void write(const Device& device);

private:
    static constexpr std::size_t capacity = 32 + maxIntermediates;
    VkWriteDescriptorSet& add(std::uint32_t binding, VkDescriptorType type);
    void buffer(std::uint32_t binding, VkDescriptorType type, const VkDescriptorBufferInfo& info);
    void image(std::uint32_t binding, VkDescriptorType type, VkImageView view, VkImageLayout layout);

    VkDescriptorSet set_;
    std::uint32_t writeCount_ = 0, bufferCount_ = 0, imageCount_ = 0;
    std::array<VkWriteDescriptorSet, capacity> writes_;
    std::array<VkDescriptorBufferInfo, capacity> buffers_;
    std::array<VkDescriptorImageInfo, capacity + maxShadowMaps> images_;
};

/// The call's ids or, in a context without them, what stands in for them.
NacreImage idsOf(const Context& context, const NacreImage& materialId);
/// The intermediate that stands in, if any: what a call touches beside its passes' own.
IntermediateSet idsIntermediate(const Context& context);

/// What recordPasses needs to know.
struct PassRecording {
    const Context& context;
    const CallLayout& callLayout;
    std::size_t technique; ///< index in `techniques`
    VkCommandBuffer commandBuffer;
    VkDescriptorSet set;
    VkExtent2D area;
    NacreTimestamps timestamps;
    IntermediateSet intermediates; ///< what this call touches; with none, it does not wait for what was recorded before
    std::uint32_t materialCount = 0; ///< the technique's materialPasses run for the slots 1 … materialCount
    Variant variant = 0;             ///< what this call asks of the passes that have the constant
    bool baked = false;              ///< materialPasses are those that were baked (nacreBakeThesisKernel)
};

/// Records the technique's passes with what lies between them: barriers, labels, timestamps.
void recordPasses(const PassRecording& recording);

} // namespace nacre::effect
