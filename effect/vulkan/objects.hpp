// The caller's device as the effect sees it, and owners for what is created on it.
#pragma once

#include "nacre/nacre.h"
#include "vulkan/dispatch_table.hpp"

#include <cstddef>
#include <string>
#include <utility>

namespace nacre::effect {

struct Device {
    VkDevice handle = VK_NULL_HANDLE;
    const VkAllocationCallbacks* allocator = nullptr; ///< null or `callbacks`, the caller's
    VkAllocationCallbacks callbacks{};
    DispatchTable vk;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
};

/// Owns one Vulkan object. The Device must outlive it and stay where it is.
template <typename Handle> class Owned {
public:
    using Destroy = void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*);

    Owned() = default;
    Owned(const Device& device, Handle handle, Destroy destroy)
        : device_(&device), handle_(handle), destroy_(destroy) {}
    Owned(Owned&& other) noexcept { *this = std::move(other); }
    Owned& operator=(Owned&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        std::swap(destroy_, other.destroy_);
        return *this;
    }
    ~Owned() {
        if (handle_ != VK_NULL_HANDLE) {
            destroy_(device_->handle, handle_, device_->allocator);
        }
    }
    Handle get() const { return handle_; }

private:
    const Device* device_ = nullptr;
    Handle handle_ = VK_NULL_HANDLE;
    Destroy destroy_ = nullptr;
};

/// A buffer. MemoryLayout gives it memory and, when the host may see that, sets `mapped`.
struct Buffer {
    Owned<VkBuffer> buffer;
    VkMemoryRequirements requirements{};
    std::byte* mapped = nullptr;
};

/// A storage image. MemoryLayout gives it memory and its view.
struct Image {
    Owned<VkImage> image;
    Owned<VkImageView> view;
    VkMemoryRequirements requirements{};
    VkFormat format = VK_FORMAT_UNDEFINED;
    bool array = false; ///< whether the view is an array view
};

Buffer createBuffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, const std::string& name);
/// A 2D image for imageLoad, imageStore and texelFetch.
Image createImage(const Device& device, VkExtent2D extent, VkFormat format, bool array, const std::string& name);
/// Binds memory to an image and makes its view.
void bindImage(const Device& device, Image& image, VkDeviceMemory memory, VkDeviceSize offset);

/// Names an object for debuggers where VK_EXT_debug_utils is enabled.
void nameObject(const Device& device, VkObjectType type, std::uint64_t handle, const std::string& name);

} // namespace nacre::effect
