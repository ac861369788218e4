// An engine that dispatches the effect's passes itself: nacre_passes.h, plain Vulkan, and no NacreContext. One
// technique, one call at a time. docs/integration.md quotes it.
#pragma once

#include "nacre/nacre_passes.h"
#include "tests/gpu/support/headless_gpu.hpp"

#include <array>
#include <map>

namespace nacre::tests {

class PartsEngine {
public:
    /// For up to materialCount materials and lightCount lights.
    PartsEngine(Gpu& gpu, NacreTechnique technique, VkExtent2D maxExtent, std::uint32_t materialCount,
                std::uint32_t lightCount = 1);
    ~PartsEngine();
    PartsEngine(const PartsEngine&) = delete;

    /// Materials 1, 2, …
    void setMaterials(std::span<const NacreMaterial> materials);
    void scatter(VkCommandBuffer commandBuffer, const NacreScatterInfo& info);
    void transmit(VkCommandBuffer commandBuffer, const NacreTransmitInfo& info);

private:
    struct Buffer {
        NacreBinding binding{};
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::byte* mapped = nullptr;
        std::byte* element(std::uint32_t index) const { return mapped + binding.head + binding.stride * index; }
    };
    void createBuffer(const NacreBinding& binding, VkDeviceSize size);
    void createIntermediateImage(const NacreBinding& binding);
    void createLayouts();
    void createPipelines();
    VkPipeline createPipeline(VkShaderModule module, std::uint32_t has, std::uint32_t variant);
    void createSet();
    void bind(const NacreBinding& binding, std::span<const NacreImage> images, const NacreImage& fallback);
    void recordPasses(VkCommandBuffer commandBuffer, VkExtent2D area, std::uint32_t constants);

    Gpu& gpu_;
    NacreTechnique technique_;
    VkExtent2D maxExtent_;
    std::vector<NacreMaterial> materials_;
    std::vector<NacreBinding> bindings_;
    std::map<std::string, Buffer> buffers_;
    std::map<std::uint32_t, GpuImage> images_;         ///< intermediates by binding
    std::vector<std::array<VkPipeline, 4>> pipelines_; ///< of the passes, by their constants, a bit each
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

} // namespace nacre::tests
