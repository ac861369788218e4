#include "memory.hpp"

#include "failure.hpp"

#include <algorithm>

namespace nacre::effect {
namespace {

constexpr VkMemoryPropertyFlags hostCoherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

/// The first memory type that has all of the earliest possible set of
/// properties.
std::uint32_t chooseMemoryType(const Device& device, std::uint32_t typeBits, MemoryUse use) {
    const VkMemoryPropertyFlags needs = use == MemoryUse::Host ? hostCoherent : 0;
    for (const VkMemoryPropertyFlags wish : {needs | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, needs}) {
        for (std::uint32_t type = 0; type < device.memory.memoryTypeCount; ++type) {
            if ((typeBits >> type & 1u) != 0 && (device.memory.memoryTypes[type].propertyFlags & wish) == wish) {
                return type;
            }
        }
    }
    fail(NACRE_ERROR_UNSUPPORTED_DEVICE,
         "the device has no memory type for the effect's resources "
         "(memoryTypeBits ",
         typeBits, ")");
}

void checkGivenMemory(const NacreMemory& given, const VkMemoryRequirements& requirements, MemoryUse use,
                      const char* field) {
    if (given.offset % requirements.alignment != 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".offset is ", given.offset, ", must be a multiple of ",
             requirements.alignment);
    }
    if (given.size < requirements.size) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, field, ".size is ", given.size, " bytes, the effect needs ", requirements.size,
             " (nacreGetMemoryRequirements)");
    }
    if (use == MemoryUse::Host && !given.mapped) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".mapped is null, the host writes this memory");
    }
}

} // namespace

void MemoryLayout::add(Buffer* buffer, Image* image, const VkMemoryRequirements& requirements) {
    const VkDeviceSize alignment = std::max(requirements.alignment, device_.limits.bufferImageGranularity);
    const VkDeviceSize offset = (requirements_.size + alignment - 1) / alignment * alignment;
    requirements_.size = offset + requirements.size;
    requirements_.alignment = std::max(requirements_.alignment, alignment);
    requirements_.memoryTypeBits &= requirements.memoryTypeBits;
    items_.push_back({buffer, image, offset});
}

Owned<VkDeviceMemory> MemoryLayout::allocate(MemoryUse use) const {
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = requirements_.size;
    info.memoryTypeIndex = chooseMemoryType(device_, requirements_.memoryTypeBits, use);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(device_.vk.AllocateMemory(device_.handle, &info, device_.allocator, &memory), "vkAllocateMemory");
    return {device_, memory, device_.vk.FreeMemory};
}

Owned<VkDeviceMemory> MemoryLayout::place(MemoryUse use, const NacreMemory& given, const char* field) const {
    Owned<VkDeviceMemory> own;
    NacreMemory memory = given;
    if (given.memory != VK_NULL_HANDLE) {
        checkGivenMemory(given, requirements_, use, field);
    } else {
        own = allocate(use);
        memory = {own.get(), 0, requirements_.size, nullptr};
        if (use == MemoryUse::Host) {
            check(device_.vk.MapMemory(device_.handle, own.get(), 0, VK_WHOLE_SIZE, 0, &memory.mapped), "vkMapMemory");
        }
    }
    for (const Item& item : items_) {
        const VkDeviceSize offset = memory.offset + item.offset;
        if (item.image) {
            bindImage(device_, *item.image, memory.memory, offset);
            continue;
        }
        check(device_.vk.BindBufferMemory(device_.handle, item.buffer->buffer.get(), memory.memory, offset),
              "vkBindBufferMemory");
        item.buffer->mapped = use == MemoryUse::Host ? static_cast<std::byte*>(memory.mapped) + item.offset : nullptr;
    }
    return own;
}

} // namespace nacre::effect
