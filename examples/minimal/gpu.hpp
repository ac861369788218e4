// As much of a Vulkan renderer as the example needs: a device, images, a buffer the host reads, compute pipelines that
// share one layout, and one submission. Throws std::runtime_error. What it makes lives as long as the process's Gpu.
#pragma once

#include <nacre/nacre.h>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

void check(VkResult result, const char* call);

struct Gpu {
    explicit Gpu(const NacreRequirements& requirements);
    ~Gpu();
    Gpu(const Gpu&) = delete;

    /// An image for compute passes, its usage included in what the effect's struct wants to know.
    NacreImage createImage(VkFormat format, VkExtent2D extent, VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_2D);
    /// A storage buffer and the host's pointer to it.
    VkBuffer createBuffer(VkDeviceSize size, void** mapped);
    /// Sets the bindings 0, 1, … of every pass: the images, then the buffer. Call once.
    void bind(std::span<const NacreImage> images, VkBuffer buffer);
    VkPipeline createPipeline(std::span<const std::uint32_t> spirv);
    /// Commands; the images are in VK_IMAGE_LAYOUT_GENERAL.
    VkCommandBuffer begin();
    void submitAndWait();

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandPool commandPool = VK_NULL_HANDLE;
    VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkDescriptorPool descriptorPool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;

private:
    VkDeviceMemory allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted);
    std::vector<VkImage> images_;
    std::vector<VkImageView> views_;
    std::vector<VkBuffer> buffers_;
    std::vector<VkDeviceMemory> memories_;
    std::vector<VkPipeline> pipelines_;
};
