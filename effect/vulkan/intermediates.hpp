// The images and buffers between passes.
#pragma once

#include "technique.hpp"
#include "vulkan/memory_layout.hpp"

namespace nacre::effect {

/// The image or buffer of an intermediate; both empty when no enabled technique uses it.
struct IntermediateResource {
    Image image;
    Buffer buffer;
    VkDeviceSize bytes() const { return image.requirements.size + buffer.requirements.size; }
};

/// By the number of the intermediate.
using IntermediateResources = std::array<IntermediateResource, maxIntermediates>;

/// Those of a set, for an extent, without memory.
IntermediateResources createIntermediates(const Device& device, IntermediateSet set, VkExtent2D extent);
/// Where they shall lie; they have to stay where they are.
MemoryLayout layOut(const Device& device, IntermediateResources& resources);

} // namespace nacre::effect
