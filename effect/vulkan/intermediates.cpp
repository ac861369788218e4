#include "vulkan/intermediates.hpp"

#include "contract/effect_error.hpp"

namespace nacre::effect {

IntermediateResources createIntermediates(const Device& device, IntermediateSet set, VkExtent2D extent) {
    IntermediateResources resources;
    for (std::size_t i = 0; i < maxIntermediates; ++i) {
        const Intermediate& info = intermediates()[i];
        if (!(set >> i & 1u)) {
            continue;
        }
        if (info.format != VK_FORMAT_UNDEFINED) {
            resources[i].image = createImage(device, info.extent(extent), info.format, info.array, info.name);
            continue;
        }
        const VkDeviceSize bytes = info.bytes(extent);
        if (bytes > device.limits.maxStorageBufferRange) {
            fail(NACRE_ERROR_LIMIT_EXCEEDED, "maxExtent is ", extent.width, "x", extent.height, ": ", info.name,
                 " would take ", bytes, " bytes, the device's maxStorageBufferRange is ",
                 device.limits.maxStorageBufferRange,
                 "; leave its technique out of "
                 "NacreContextInfo::techniques or lower maxExtent");
        }
        resources[i].buffer = createBuffer(
            device, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, info.name);
    }
    return resources;
}

MemoryLayout layOut(const Device& device, IntermediateResources& resources) {
    MemoryLayout layout(device);
    for (IntermediateResource& resource : resources) {
        if (resource.image.image.get() != VK_NULL_HANDLE) {
            layout.add(resource.image);
        } else if (resource.buffer.buffer.get() != VK_NULL_HANDLE) {
            layout.add(resource.buffer);
        }
    }
    return layout;
}

} // namespace nacre::effect
