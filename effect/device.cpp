#include "device.hpp"

#include "failure.hpp"

#include <initializer_list>

namespace nacre::effect {
namespace {

/// The first memory type that has all of the earliest possible set of properties.
std::uint32_t chooseMemoryType(const Device& device, std::uint32_t typeBits,
                               std::initializer_list<VkMemoryPropertyFlags> wishes) {
    for (const VkMemoryPropertyFlags wish : wishes) {
        for (std::uint32_t type = 0; type < device.memory.memoryTypeCount; ++type) {
            if ((typeBits >> type & 1u) != 0 && (device.memory.memoryTypes[type].propertyFlags & wish) == wish) {
                return type;
            }
        }
    }
    fail(NACRE_ERROR_UNSUPPORTED_DEVICE, "the device has no memory type for the effect's resources (memoryTypeBits ",
         typeBits, ")");
}

Owned<VkDeviceMemory> allocate(const Device& device, const VkMemoryRequirements& requirements, std::uint32_t type) {
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = requirements.size;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(device.vk.AllocateMemory(device.handle, &info, device.allocator, &memory), "vkAllocateMemory");
    return {device, memory, device.vk.FreeMemory};
}

Buffer createBuffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, const std::string& name,
                    std::initializer_list<VkMemoryPropertyFlags> wishes) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = usage;
    VkBuffer handle = VK_NULL_HANDLE;
    check(device.vk.CreateBuffer(device.handle, &info, device.allocator, &handle), "vkCreateBuffer");
    Buffer buffer;
    buffer.buffer = {device, handle, device.vk.DestroyBuffer};
    VkMemoryRequirements requirements{};
    device.vk.GetBufferMemoryRequirements(device.handle, handle, &requirements);
    buffer.memory = allocate(device, requirements, chooseMemoryType(device, requirements.memoryTypeBits, wishes));
    buffer.size = requirements.size;
    check(device.vk.BindBufferMemory(device.handle, handle, buffer.memory.get(), 0), "vkBindBufferMemory");
    nameObject(device, VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(handle), name);
    return buffer;
}

} // namespace

Buffer createHostBuffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, const std::string& name) {
    constexpr VkMemoryPropertyFlags hostVisible =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    Buffer buffer =
        createBuffer(device, size, usage, name, {hostVisible | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, hostVisible});
    void* mapped = nullptr;
    check(device.vk.MapMemory(device.handle, buffer.memory.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    buffer.mapped = static_cast<std::byte*>(mapped);
    return buffer;
}

Buffer createDeviceBuffer(const Device& device, VkDeviceSize size, const std::string& name) {
    return createBuffer(device, size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, name,
                        {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0});
}

Image createImage(const Device& device, VkExtent2D extent, VkFormat format, bool array, const std::string& name) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    VkImage handle = VK_NULL_HANDLE;
    check(device.vk.CreateImage(device.handle, &info, device.allocator, &handle), "vkCreateImage");
    Image image;
    image.image = {device, handle, device.vk.DestroyImage};
    VkMemoryRequirements requirements{};
    device.vk.GetImageMemoryRequirements(device.handle, handle, &requirements);
    image.memory =
        allocate(device, requirements,
                 chooseMemoryType(device, requirements.memoryTypeBits, {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0}));
    image.size = requirements.size;
    check(device.vk.BindImageMemory(device.handle, handle, image.memory.get(), 0), "vkBindImageMemory");

    VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewInfo.image = handle;
    viewInfo.viewType = array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.format = format;
    viewInfo.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(device.vk.CreateImageView(device.handle, &viewInfo, device.allocator, &view), "vkCreateImageView");
    image.view = {device, view, device.vk.DestroyImageView};
    nameObject(device, VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(handle), name);
    return image;
}

void nameObject(const Device& device, VkObjectType type, std::uint64_t handle, const std::string& name) {
    if (!device.vk.SetDebugUtilsObjectNameEXT) {
        return;
    }
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = name.c_str();
    device.vk.SetDebugUtilsObjectNameEXT(device.handle, &info);
}

} // namespace nacre::effect
