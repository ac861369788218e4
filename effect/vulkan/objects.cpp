#include "vulkan/objects.hpp"

#include "contract/effect_error.hpp"

namespace nacre::effect {

Buffer createBuffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, const std::string& name) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = usage;
    VkBuffer handle = VK_NULL_HANDLE;
    check(device.vk.CreateBuffer(device.handle, &info, device.allocator, &handle), "vkCreateBuffer");
    Buffer buffer;
    buffer.buffer = {device, handle, device.vk.DestroyBuffer};
    device.vk.GetBufferMemoryRequirements(device.handle, handle, &buffer.requirements);
    nameObject(device, VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(handle), name);
    return buffer;
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
    image.format = format;
    image.array = array;
    device.vk.GetImageMemoryRequirements(device.handle, handle, &image.requirements);
    nameObject(device, VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(handle), name);
    return image;
}

void bindImage(const Device& device, Image& image, VkDeviceMemory memory, VkDeviceSize offset) {
    check(device.vk.BindImageMemory(device.handle, image.image.get(), memory, offset), "vkBindImageMemory");
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = image.image.get();
    info.viewType = image.array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    info.format = image.format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(device.vk.CreateImageView(device.handle, &info, device.allocator, &view), "vkCreateImageView");
    image.view = {device, view, device.vk.DestroyImageView};
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
