// The caller's device as the effect sees it, and owners for what is created on it.
#pragma once

#include "dispatch_table.hpp"

#include <cstddef>
#include <string>
#include <utility>

namespace nacre::effect {

struct Device {
    VkDevice handle = VK_NULL_HANDLE;
    const VkAllocationCallbacks* allocator = nullptr;
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

/// A buffer with memory of its own; `mapped` is null when the host cannot see it.
struct Buffer {
    Owned<VkDeviceMemory> memory;
    Owned<VkBuffer> buffer;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr;
};

/// A storage image with memory of its own.
struct Image {
    Owned<VkDeviceMemory> memory;
    Owned<VkImage> image;
    Owned<VkImageView> view;
    VkDeviceSize size = 0;
};

/// A buffer the host writes and the device reads, in device memory where the host can reach it.
Buffer createHostBuffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, const std::string& name);
/// A storage buffer for the device alone, usable for indirect dispatches.
Buffer createDeviceBuffer(const Device& device, VkDeviceSize size, const std::string& name);
/// A 2D image for imageLoad, imageStore and texelFetch; its view is an array view when `array` is set.
Image createImage(const Device& device, VkExtent2D extent, VkFormat format, bool array, const std::string& name);

/// Names an object for debuggers where VK_EXT_debug_utils is enabled.
void nameObject(const Device& device, VkObjectType type, std::uint64_t handle, const std::string& name);

} // namespace nacre::effect
