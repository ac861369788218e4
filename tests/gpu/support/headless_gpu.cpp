#include "tests/gpu/support/headless_gpu.hpp"

#include "tests/gpu/support/shared_pipelines.hpp"

#include <algorithm>
#include <stdexcept>

namespace nacre::tests {
namespace {

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(call) + " returned VkResult " + std::to_string(result));
    }
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* userData) {
    static_cast<std::vector<std::string>*>(userData)->push_back(data->pMessage);
    return VK_FALSE;
}

VkImageAspectFlags aspectOf(VkFormat format) {
    switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
        return VK_IMAGE_ASPECT_DEPTH_BIT;
    case VK_FORMAT_D16_UNORM_S8_UINT:
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
        return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    case VK_FORMAT_S8_UINT:
        return VK_IMAGE_ASPECT_STENCIL_BIT;
    default:
        return VK_IMAGE_ASPECT_COLOR_BIT;
    }
}

/// What is uploaded, and seen by a view: of depth and stencil the depth.
VkImageAspectFlags firstAspectOf(VkFormat format) {
    const VkImageAspectFlags aspect = aspectOf(format);
    return (aspect & VK_IMAGE_ASPECT_DEPTH_BIT) != 0 ? VkImageAspectFlags{VK_IMAGE_ASPECT_DEPTH_BIT} : aspect;
}

} // namespace

std::size_t texelBytes(VkFormat format) {
    switch (format) {
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return 16;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32_SFLOAT:
        return 8;
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_X8_D24_UNORM_PACK32: // a depth aspect's copy has 4 bytes, whatever the stencil
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
    case VK_FORMAT_R8G8B8A8_UINT:
    case VK_FORMAT_R16G16_SFLOAT:
    case VK_FORMAT_R16G16_UNORM:
    case VK_FORMAT_R16G16_SNORM:
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SNORM:
        return 4;
    case VK_FORMAT_R16_UINT:
    case VK_FORMAT_R16_UNORM:
    case VK_FORMAT_R16_SFLOAT:
    case VK_FORMAT_D16_UNORM:
        return 2;
    case VK_FORMAT_R8_UINT:
    case VK_FORMAT_R8_UNORM:
    case VK_FORMAT_S8_UINT:
        return 1;
    default:
        throw std::runtime_error("texelBytes: VkFormat " + std::to_string(format));
    }
}

struct Gpu::Staging {
    VkDevice device;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
    ~Staging() {
        vkDestroyBuffer(device, buffer, nullptr);
        vkFreeMemory(device, memory, nullptr);
    }
};

GpuImage& GpuImage::operator=(GpuImage&& other) noexcept {
    std::swap(gpu, other.gpu);
    std::swap(image, other.image);
    std::swap(view, other.view);
    std::swap(memory, other.memory);
    std::swap(format, other.format);
    std::swap(layout, other.layout);
    std::swap(extent, other.extent);
    std::swap(usage, other.usage);
    std::swap(layers, other.layers);
    std::swap(layerViews, other.layerViews);
    return *this;
}

GpuImage::~GpuImage() {
    if (gpu) {
        vkDestroyImageView(gpu->device, view, nullptr);
        for (const VkImageView layer : layerViews) {
            vkDestroyImageView(gpu->device, layer, nullptr);
        }
        vkDestroyImage(gpu->device, image, nullptr);
        vkFreeMemory(gpu->device, memory, nullptr);
    }
}

Gpu& Gpu::instance() {
    static Gpu gpu;
    return gpu;
}

Gpu::Gpu(bool validation) {
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const VkValidationFeatureEnableEXT enabled[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;
    VkDebugUtilsMessengerCreateInfoEXT messengerInfo{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messengerInfo.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messengerInfo.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messengerInfo.pfnUserCallback = onMessage;
    messengerInfo.pUserData = &messages_;
    features.pNext = &messengerInfo;
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instanceInfo.pApplicationInfo = &application;
    if (validation) {
        instanceInfo.pNext = &features;
        instanceInfo.enabledLayerCount = 1;
        instanceInfo.ppEnabledLayerNames = &layer;
        instanceInfo.enabledExtensionCount = 2;
        instanceInfo.ppEnabledExtensionNames = extensions;
    }
    check(vkCreateInstance(&instanceInfo, nullptr, &vkInstance), "vkCreateInstance");
    if (validation) {
        const auto createMessenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(vkInstance, "vkCreateDebugUtilsMessengerEXT"));
        check(createMessenger(vkInstance, &messengerInfo, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
    }

    std::uint32_t count = 1;
    const VkResult found = vkEnumeratePhysicalDevices(vkInstance, &count, &physicalDevice);
    if ((found != VK_SUCCESS && found != VK_INCOMPLETE) || count == 0) {
        throw std::runtime_error("no Vulkan device");
    }
    vkGetPhysicalDeviceProperties(physicalDevice, &properties);
    std::uint32_t familyCount = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice, &familyCount, nullptr);
    std::vector<VkQueueFamilyProperties> families(familyCount);
    vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice, &familyCount, families.data());
    while ((families.at(queueFamily).queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) {
        ++queueFamily;
    }
    NacreRequirements requirements;
    nacreGetRequirements(&requirements);
    const float priority = 1;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = queueFamily;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkPhysicalDeviceVulkan12Features offered{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 query{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &offered, {}};
    vkGetPhysicalDeviceFeatures2(physicalDevice, &query);
    shaderFloat16 = offered.shaderFloat16;
    requirements.features12.shaderFloat16 = offered.shaderFloat16;
    VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    deviceInfo.pNext = &requirements.features12;
    deviceInfo.queueCreateInfoCount = 1;
    deviceInfo.pQueueCreateInfos = &queueInfo;
    deviceInfo.pEnabledFeatures = &requirements.features;
    check(vkCreateDevice(physicalDevice, &deviceInfo, nullptr, &device), "vkCreateDevice");
    vkGetDeviceQueue(device, queueFamily, 0, &queue);
    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.queueFamilyIndex = queueFamily;
    check(vkCreateCommandPool(device, &poolInfo, nullptr, &commandPool), "vkCreateCommandPool");
}

Gpu::~Gpu() {
    destroySharedPipelines(device);
    vkDestroyCommandPool(device, commandPool, nullptr);
    vkDestroyDevice(device, nullptr);
    if (messenger_ != VK_NULL_HANDLE) {
        const auto destroyMessenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(vkInstance, "vkDestroyDebugUtilsMessengerEXT"));
        destroyMessenger(vkInstance, messenger_, nullptr);
    }
    vkDestroyInstance(vkInstance, nullptr);
}

std::vector<std::string> Gpu::takeMessages() {
    return std::exchange(messages_, {});
}

std::uint32_t Gpu::memoryType(std::uint32_t bits, VkMemoryPropertyFlags wanted) const {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physicalDevice, &memory);
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        if ((bits >> i & 1u) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) {
            return i;
        }
    }
    if (wanted == VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) {
        return memoryType(bits, 0);
    }
    throw std::runtime_error("no memory type");
}

Gpu::Staging Gpu::createStaging(VkDeviceSize size) {
    Staging staging{device};
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    check(vkCreateBuffer(device, &info, nullptr, &staging.buffer), "vkCreateBuffer");
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device, staging.buffer, &requirements);
    VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocation.allocationSize = requirements.size;
    allocation.memoryTypeIndex = memoryType(requirements.memoryTypeBits,
                                            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkAllocateMemory(device, &allocation, nullptr, &staging.memory), "vkAllocateMemory");
    check(vkBindBufferMemory(device, staging.buffer, staging.memory, 0), "vkBindBufferMemory");
    check(vkMapMemory(device, staging.memory, 0, VK_WHOLE_SIZE, 0, &staging.mapped), "vkMapMemory");
    return staging;
}

GpuImage Gpu::createImage(const ImageSettings& settings) {
    GpuImage result;
    result.gpu = this;
    result.format = settings.format;
    result.layout = settings.layout;
    result.extent = settings.extent;
    result.layers = settings.layers;
    const bool isDepth = aspectOf(settings.format) != VK_IMAGE_ASPECT_COLOR_BIT;
    // A depth image's read-only layout asks for more than sampling.
    constexpr VkImageUsageFlags depthUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    result.usage =
        (isDepth ? depthUsage : settings.usage) | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = settings.format;
    info.extent = {settings.extent.width, settings.extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = settings.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = result.usage;
    check(vkCreateImage(device, &info, nullptr, &result.image), "vkCreateImage");
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device, result.image, &requirements);
    VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocation.allocationSize = requirements.size;
    allocation.memoryTypeIndex = memoryType(requirements.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkAllocateMemory(device, &allocation, nullptr, &result.memory), "vkAllocateMemory");
    check(vkBindImageMemory(device, result.image, result.memory, 0), "vkBindImageMemory");
    VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewInfo.image = result.image;
    viewInfo.viewType = settings.array || settings.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.format = settings.format;
    viewInfo.components = settings.components;
    const VkImageAspectFlags stencil = VK_IMAGE_ASPECT_STENCIL_BIT;
    viewInfo.subresourceRange = {settings.stencil ? stencil : firstAspectOf(settings.format), 0, 1, 0, settings.layers};
    check(vkCreateImageView(device, &viewInfo, nullptr, &result.view), "vkCreateImageView");
    viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.subresourceRange.layerCount = 1;
    for (std::uint32_t layer = 0; settings.layerViews && layer < settings.layers; ++layer) {
        viewInfo.subresourceRange.baseArrayLayer = layer;
        check(vkCreateImageView(device, &viewInfo, nullptr, &result.layerViews.emplace_back()), "vkCreateImageView");
    }
    run([&](VkCommandBuffer commandBuffer) {
        transition(commandBuffer, result, VK_IMAGE_LAYOUT_UNDEFINED, result.layout);
    });
    return result;
}

void Gpu::transition(VkCommandBuffer commandBuffer, const GpuImage& image, VkImageLayout from, VkImageLayout to) const {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.image;
    barrier.subresourceRange = {aspectOf(image.format), 0, 1, 0, image.layers};
    vkCmdPipelineBarrier(commandBuffer, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                         nullptr, 0, nullptr, 1, &barrier);
}

GpuImage Gpu::createShadowMap(std::uint32_t size, const std::vector<float>& texels) {
    GpuImage image = createImage({.format = VK_FORMAT_R32_SFLOAT,
                                  .extent = {size, size},
                                  .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                  .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                  .layers = static_cast<std::uint32_t>(texels.size() / (std::size_t{size} * size)),
                                  .array = true});
    upload(image, texels);
    return image;
}

void Gpu::upload(GpuImage& image, std::span<const std::byte> texels) {
    const std::size_t bytes = texelBytes(image.format) * image.extent.width * image.extent.height * image.layers;
    if (texels.size() != bytes) {
        throw std::runtime_error("upload: " + std::to_string(texels.size()) + " bytes for an image of " +
                                 std::to_string(bytes));
    }
    const Staging staging = createStaging(bytes);
    std::memcpy(staging.mapped, texels.data(), bytes);
    run([&](VkCommandBuffer commandBuffer) {
        transition(commandBuffer, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        VkBufferImageCopy region{};
        region.imageSubresource = {firstAspectOf(image.format), 0, 0, image.layers};
        region.imageExtent = {image.extent.width, image.extent.height, 1};
        vkCmdCopyBufferToImage(commandBuffer, staging.buffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                               &region);
        transition(commandBuffer, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, image.layout);
    });
}

std::vector<std::byte> Gpu::downloadBytes(const GpuImage& image) {
    const std::size_t bytes = texelBytes(image.format) * image.extent.width * image.extent.height * image.layers;
    const Staging staging = createStaging(bytes);
    run([&](VkCommandBuffer commandBuffer) {
        transition(commandBuffer, image, image.layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        VkBufferImageCopy region{};
        region.imageSubresource = {firstAspectOf(image.format), 0, 0, image.layers};
        region.imageExtent = {image.extent.width, image.extent.height, 1};
        vkCmdCopyImageToBuffer(commandBuffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging.buffer, 1,
                               &region);
        transition(commandBuffer, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image.layout);
    });
    std::vector<std::byte> result(bytes);
    std::memcpy(result.data(), staging.mapped, bytes);
    return result;
}

VkCommandBuffer Gpu::begin() {
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = commandPool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device, &info, &commandBuffer), "vkAllocateCommandBuffers");
    VkCommandBufferBeginInfo beginInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    beginInfo.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commandBuffer, &beginInfo), "vkBeginCommandBuffer");
    return commandBuffer;
}

void Gpu::submit(VkCommandBuffer commandBuffer) {
    check(vkEndCommandBuffer(commandBuffer), "vkEndCommandBuffer");
    VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commandBuffer;
    check(vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(queue), "vkQueueWaitIdle");
    vkFreeCommandBuffers(device, commandPool, 1, &commandBuffer);
}

void Gpu::run(const std::function<void(VkCommandBuffer)>& record) {
    const VkCommandBuffer commandBuffer = begin();
    record(commandBuffer);
    submit(commandBuffer);
}

std::vector<double> Gpu::runTimed(std::uint32_t count,
                                  const std::function<void(VkCommandBuffer, VkQueryPool)>& record) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = count;
    VkQueryPool pool = VK_NULL_HANDLE;
    check(vkCreateQueryPool(device, &info, nullptr, &pool), "vkCreateQueryPool");
    run([&](VkCommandBuffer commandBuffer) {
        vkCmdResetQueryPool(commandBuffer, pool, 0, count);
        record(commandBuffer, pool);
    });
    std::vector<std::uint64_t> ticks(count);
    check(vkGetQueryPoolResults(device, pool, 0, count, count * sizeof(std::uint64_t), ticks.data(),
                                sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
    vkDestroyQueryPool(device, pool, nullptr);
    std::vector<double> microseconds;
    for (std::uint32_t i = 1; i < count; ++i) {
        microseconds.push_back(static_cast<double>(ticks[i] - ticks[i - 1]) *
                               static_cast<double>(properties.limits.timestampPeriod) * 1e-3);
    }
    return microseconds;
}

NacreContextInfo Gpu::contextInfo(VkExtent2D maxExtent) const {
    NacreContextInfo info{};
    info.headerVersion = NACRE_HEADER_VERSION;
    info.instance = vkInstance;
    info.physicalDevice = physicalDevice;
    info.device = device;
    info.getInstanceProcAddr = sharingGetInstanceProcAddr;
    info.maxExtent = maxExtent;
    return info;
}

} // namespace nacre::tests
