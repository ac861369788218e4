#include "vulkan/memory_layout.hpp"

#include "contract/effect_error.hpp"

#include <algorithm>

namespace nacre::effect {
namespace {

constexpr VkMemoryPropertyFlags hostCoherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

/// Memory types that will do, those in device memory first. Many devices have little of it that the host can write.
std::vector<std::uint32_t> memoryTypes(const Device& device, const VkMemoryRequirements& requirements, MemoryUse use) {
    const VkMemoryPropertyFlags needs = use == MemoryUse::Host ? hostCoherent : 0;
    std::vector<std::uint32_t> types;
    for (const VkMemoryPropertyFlags local : {VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT}, 0u}) {
        for (std::uint32_t type = 0; type < device.memory.memoryTypeCount; ++type) {
            const VkMemoryType& memory = device.memory.memoryTypes[type];
            if ((requirements.memoryTypeBits >> type & 1u) != 0 && (memory.propertyFlags & needs) == needs &&
                (memory.propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) == local &&
                device.memory.memoryHeaps[memory.heapIndex].size >= requirements.size) {
                types.push_back(type);
            }
        }
    }
    return types;
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
    for (const std::uint32_t type : memoryTypes(device_, requirements_, use)) {
        info.memoryTypeIndex = type;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        const VkResult result = device_.vk.AllocateMemory(device_.handle, &info, device_.allocator, &memory);
        if (result != VK_ERROR_OUT_OF_DEVICE_MEMORY) {
            check(result, "vkAllocateMemory");
            return {device_, memory, device_.vk.FreeMemory};
        }
    }
    fail(NACRE_ERROR_OUT_OF_MEMORY, "the device has no ", requirements_.size, " bytes of ",
         use == MemoryUse::Host ? "host-visible" : "device", " memory for the effect (memoryTypeBits 0x", std::hex,
         requirements_.memoryTypeBits, ")");
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
