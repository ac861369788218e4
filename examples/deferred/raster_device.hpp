// As much of a Vulkan 1.3 renderer as the example needs: a device, images that know how they were used last, pipelines,
// and frames in flight. Throws std::runtime_error.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

void check(VkResult result, const char* call);

/// How an image is used: what a barrier has to know.
struct Use {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
};
inline constexpr VkPipelineStageFlags2 depthStages =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
inline constexpr VkPipelineStageFlags2 readingStages =
    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
// [snippet: raster-uses]
inline constexpr Use colorTarget{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                 VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                 VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT};
inline constexpr Use depthTarget{VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, depthStages,
                                 VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                                     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT};
inline constexpr Use colorRead{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, readingStages, VK_ACCESS_2_SHADER_READ_BIT};
inline constexpr Use depthRead{VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL, readingStages,
                               VK_ACCESS_2_SHADER_READ_BIT};
inline constexpr Use computeWrite{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                  VK_ACCESS_2_SHADER_WRITE_BIT};
inline constexpr Use generalRead{VK_IMAGE_LAYOUT_GENERAL, readingStages, VK_ACCESS_2_SHADER_READ_BIT};
// [end]
inline constexpr Use copySource{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                VK_ACCESS_2_TRANSFER_READ_BIT};

struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;        ///< of all layers; of depth and stencil the depth
    VkImageView stencilView = VK_NULL_HANDLE; ///< where there is one
    std::vector<VkImageView> layers;          ///< one by one
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    VkImageUsageFlags usage = 0;
    VkImageAspectFlags aspects = 0;
    Use last;
};

struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
};

/// What a graphics pipeline is made of here.
struct PipelineInfo {
    std::span<const std::uint32_t> vertex, fragment; ///< no fragment shader: empty
    std::vector<VkFormat> colors;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkCompareOp compare = VK_COMPARE_OP_ALWAYS;
    bool writesStencil = false; ///< the dynamic reference
    bool adds = false;          ///< blends by adding
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

struct Device {
    Device(const VkPhysicalDeviceFeatures& features, VkPhysicalDeviceVulkan12Features features12);
    ~Device();
    Device(const Device&) = delete;

    Image createImage(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage, std::uint32_t layers = 0,
                      VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT);
    void destroy(Image& image);
    Buffer createBuffer(VkDeviceSize size, VkBufferUsageFlags usage);
    VkPipeline createPipeline(const PipelineInfo& info);
    /// Bindings 1, 2, … of a frame's set.
    void bind(std::uint32_t frame, std::span<const VkDescriptorImageInfo> images);
    /// Makes frames in flight, each with a uniform block of this size.
    void createFrames(std::uint32_t count, VkDeviceSize uniformBytes);

    struct Frame {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence finished = VK_NULL_HANDLE;
        VkDescriptorSet set = VK_NULL_HANDLE;
        Buffer uniforms;
    };

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkSampler sampler = VK_NULL_HANDLE;
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::vector<Frame> frames;

private:
    VkDeviceMemory allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted);
    VkShaderModule createModule(std::span<const std::uint32_t> spirv);
    VkCommandPool commandPool_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptorPool_ = VK_NULL_HANDLE;
    std::vector<VkPipeline> pipelines_;
    std::vector<Buffer> buffers_;
};

/// A barrier from how the image was used last to how it is now. discard: what is in it is not needed any more.
void use(VkCommandBuffer commands, Image& image, const Use& next, bool discard = false);
