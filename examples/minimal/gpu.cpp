#include "gpu.hpp"

#include <stdexcept>
#include <string>

namespace {

constexpr std::uint32_t pushConstantBytes = 112;

/// The first queue family that computes.
std::uint32_t findQueueFamily(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    std::uint32_t family = 0;
    while ((families.at(family).queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) {
        ++family;
    }
    return family;
}

} // namespace

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(call) + " returned VkResult " + std::to_string(result));
    }
}

Gpu::Gpu(const NacreRequirements& requirements) {
    // [snippet: device]
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = requirements.apiVersion;
    // [end]
    VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instanceInfo.pApplicationInfo = &application;
    check(vkCreateInstance(&instanceInfo, nullptr, &instance), "vkCreateInstance");
    std::uint32_t count = 1;
    const VkResult found = vkEnumeratePhysicalDevices(instance, &count, &physicalDevice);
    if ((found != VK_SUCCESS && found != VK_INCOMPLETE) || count == 0) {
        throw std::runtime_error("there is no Vulkan device");
    }
    const float priority = 1;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = findQueueFamily(physicalDevice);
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    deviceInfo.queueCreateInfoCount = 1;
    deviceInfo.pQueueCreateInfos = &queueInfo;
    // [snippet: features]
    NacreRequirements wanted = requirements;
    deviceInfo.pEnabledFeatures = &wanted.features;
    deviceInfo.pNext = &wanted.features12;
    // [end]
    check(vkCreateDevice(physicalDevice, &deviceInfo, nullptr, &device), "vkCreateDevice");
    vkGetDeviceQueue(device, queueInfo.queueFamilyIndex, 0, &queue);
    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.queueFamilyIndex = queueInfo.queueFamilyIndex;
    check(vkCreateCommandPool(device, &poolInfo, nullptr, &commandPool), "vkCreateCommandPool");
}

Gpu::~Gpu() {
    for (const VkPipeline pipeline : pipelines_) {
        vkDestroyPipeline(device, pipeline, nullptr);
    }
    for (const VkImageView view : views_) {
        vkDestroyImageView(device, view, nullptr);
    }
    for (const VkImage image : images_) {
        vkDestroyImage(device, image, nullptr);
    }
    for (const VkBuffer buffer : buffers_) {
        vkDestroyBuffer(device, buffer, nullptr);
    }
    for (const VkDeviceMemory memory : memories_) {
        vkFreeMemory(device, memory, nullptr);
    }
    vkDestroyPipelineLayout(device, layout, nullptr);
    vkDestroyDescriptorPool(device, descriptorPool, nullptr);
    vkDestroyDescriptorSetLayout(device, setLayout, nullptr);
    vkDestroyCommandPool(device, commandPool, nullptr);
    vkDestroyDevice(device, nullptr);
    vkDestroyInstance(instance, nullptr);
}

VkDeviceMemory Gpu::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physicalDevice, &memory);
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = requirements.size;
    while (info.memoryTypeIndex < memory.memoryTypeCount &&
           ((requirements.memoryTypeBits >> info.memoryTypeIndex & 1u) == 0 ||
            (memory.memoryTypes[info.memoryTypeIndex].propertyFlags & wanted) != wanted)) {
        ++info.memoryTypeIndex;
    }
    VkDeviceMemory result = VK_NULL_HANDLE;
    check(vkAllocateMemory(device, &info, nullptr, &result), "vkAllocateMemory");
    memories_.push_back(result);
    return result;
}

NacreImage Gpu::createImage(VkFormat format, VkExtent2D extent, VkImageViewType viewType) {
    // [snippet: image]
    NacreImage image{};
    image.format = format;
    image.layout = VK_IMAGE_LAYOUT_GENERAL;
    image.extent = extent;
    image.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    // [end]
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = image.usage;
    check(vkCreateImage(device, &info, nullptr, &images_.emplace_back()), "vkCreateImage");
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device, images_.back(), &requirements);
    check(vkBindImageMemory(device, images_.back(), allocate(requirements, 0), 0), "vkBindImageMemory");
    VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewInfo.image = images_.back();
    viewInfo.viewType = viewType;
    viewInfo.format = format;
    viewInfo.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    check(vkCreateImageView(device, &viewInfo, nullptr, &image.view), "vkCreateImageView");
    views_.push_back(image.view);
    return image;
}

VkBuffer Gpu::createBuffer(VkDeviceSize size, void** mapped) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(device, &info, nullptr, &buffer), "vkCreateBuffer");
    buffers_.push_back(buffer);
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device, buffer, &requirements);
    const VkDeviceMemory memory =
        allocate(requirements, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkBindBufferMemory(device, buffer, memory, 0), "vkBindBufferMemory");
    check(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, mapped), "vkMapMemory");
    return buffer;
}

void Gpu::bind(std::span<const NacreImage> images, VkBuffer buffer) {
    const auto imageCount = static_cast<std::uint32_t>(images.size());
    std::vector<VkDescriptorSetLayoutBinding> bindings(imageCount + 1);
    std::vector<VkDescriptorImageInfo> imageInfos(imageCount);
    const VkDescriptorBufferInfo bufferInfo{buffer, 0, VK_WHOLE_SIZE};
    std::vector<VkWriteDescriptorSet> writes(imageCount + 1, {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET});
    for (std::uint32_t i = 0; i <= imageCount; ++i) {
        const bool isImage = i < imageCount;
        const VkDescriptorType type = isImage ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        bindings[i] = {i, type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = type;
        writes[i].pBufferInfo = &bufferInfo;
        if (isImage) {
            imageInfos[i] = {VK_NULL_HANDLE, images[i].view, images[i].layout};
            writes[i].pImageInfo = &imageInfos[i];
        }
    }
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = imageCount + 1;
    setInfo.pBindings = bindings.data();
    check(vkCreateDescriptorSetLayout(device, &setInfo, nullptr, &setLayout), "vkCreateDescriptorSetLayout");
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, imageCount},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1}};
    VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = 2;
    poolInfo.pPoolSizes = sizes;
    check(vkCreateDescriptorPool(device, &poolInfo, nullptr, &descriptorPool), "vkCreateDescriptorPool");
    VkDescriptorSetAllocateInfo allocation{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocation.descriptorPool = descriptorPool;
    allocation.descriptorSetCount = 1;
    allocation.pSetLayouts = &setLayout;
    check(vkAllocateDescriptorSets(device, &allocation, &set), "vkAllocateDescriptorSets");
    for (VkWriteDescriptorSet& write : writes) {
        write.dstSet = set;
    }
    vkUpdateDescriptorSets(device, imageCount + 1, writes.data(), 0, nullptr);
    const VkPushConstantRange constants{VK_SHADER_STAGE_COMPUTE_BIT, 0, pushConstantBytes};
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout;
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &constants;
    check(vkCreatePipelineLayout(device, &layoutInfo, nullptr, &layout), "vkCreatePipelineLayout");
}

VkPipeline Gpu::createPipeline(std::span<const std::uint32_t> spirv) {
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = spirv.size_bytes();
    moduleInfo.pCode = spirv.data();
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.pName = "main";
    info.layout = layout;
    check(vkCreateShaderModule(device, &moduleInfo, nullptr, &info.stage.module), "vkCreateShaderModule");
    const VkResult result =
        vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipelines_.emplace_back());
    vkDestroyShaderModule(device, info.stage.module, nullptr);
    check(result, "vkCreateComputePipelines");
    return pipelines_.back();
}

VkCommandBuffer Gpu::begin() {
    VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocation.commandPool = commandPool;
    allocation.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device, &allocation, &commandBuffer), "vkAllocateCommandBuffers");
    VkCommandBufferBeginInfo beginInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(vkBeginCommandBuffer(commandBuffer, &beginInfo), "vkBeginCommandBuffer");
    for (const VkImage image : images_) {
        VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
        barrier.dstAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image;
        barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        vkCmdPipelineBarrier(commandBuffer, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0,
                             0, nullptr, 0, nullptr, 1, &barrier);
    }
    return commandBuffer;
}

void Gpu::submitAndWait() {
    check(vkEndCommandBuffer(commandBuffer), "vkEndCommandBuffer");
    VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commandBuffer;
    check(vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(queue), "vkQueueWaitIdle");
}
