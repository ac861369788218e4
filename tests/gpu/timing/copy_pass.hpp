// A pass that copies a scatter call's images: what no technique can be faster than.
#pragma once

#include "tests/gpu/support/effect.hpp"

namespace nacre::tests {

class CopyPass {
public:
    CopyPass(Gpu& gpu, const NacreScatterInfo& info);
    ~CopyPass();
    CopyPass(const CopyPass&) = delete;

    /// Records it between timestamps `first` and `first` + 1, ordered after and before everything else.
    void record(VkCommandBuffer commandBuffer, VkQueryPool pool, std::uint32_t first) const;

private:
    void createPipeline();
    void createSet(const NacreScatterInfo& info);

    Gpu& gpu_;
    VkExtent2D extent_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

} // namespace nacre::tests
