// Where buffers and images lie: one after the other in one piece of memory, the
// caller's or the library's.
#pragma once

#include "vulkan/objects.hpp"

#include <vector>

namespace nacre::effect {

enum class MemoryUse {
    Device, ///< in device memory where there is some
    Host,   ///< the host writes it through Buffer::mapped; in device memory where
            ///< it can reach that
};

class MemoryLayout {
public:
    explicit MemoryLayout(const Device& device) : device_(device) {}

    /// The resource has to stay where it is until it is placed.
    void add(Buffer& buffer) { add(&buffer, nullptr, buffer.requirements); }
    void add(Image& image) { add(nullptr, &image, image.requirements); }
    const VkMemoryRequirements& requirements() const { return requirements_; }

    /// Binds all resources to `given` or, when its memory is null, to new memory, which is returned. `field` names
    /// `given`.
    Owned<VkDeviceMemory> place(MemoryUse use, const NacreMemory& given, const char* field) const;

private:
    struct Item {
        Buffer* buffer;
        Image* image;
        VkDeviceSize offset;
    };
    void add(Buffer* buffer, Image* image, const VkMemoryRequirements& requirements);
    Owned<VkDeviceMemory> allocate(MemoryUse use) const;

    const Device& device_;
    VkMemoryRequirements requirements_{0, 1, ~0u};
    std::vector<Item> items_;
};

} // namespace nacre::effect
