// A small render hardware interface as engines have it whose resources carry the state they are in: resources in pools
// by handle, memory in blocks, programs whose set layout has what their SPIR-V binds, a fresh descriptor set for every
// dispatch, and barriers that follow from the states a dispatch asks for. It knows nothing of the effect.
#pragma once

#include "tests/gpu/support/headless_gpu.hpp"

#include <map>
#include <span>
#include <vector>

namespace nacre::tests {

/// What a resource is ready for. States that only read go together.
enum State : std::uint32_t {
    StateUnknown = 0, ///< the contents are not needed
    StateUniform = 1,
    StateSampled = 2,
    StateStorageRead = 4,
    StateStorageWrite = 8,
    StateIndirect = 16,
};
using States = std::uint32_t;

class TrackedDevice {
public:
    using Handle = std::size_t;
    struct Slot {
        std::uint32_t binding;
        VkDescriptorType type;
        std::uint32_t count;
    };
    struct Program {
        VkPipeline pipeline = VK_NULL_HANDLE;
        VkPipelineLayout layout = VK_NULL_HANDLE;
        VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
        std::vector<Slot> slots; ///< those that it binds
    };
    /// A resource at a binding, or several in an array, and what the dispatch does with it.
    struct Bound {
        std::vector<Handle> resources;
        States states = StateUnknown;
    };
    struct Dispatch {
        const Program* program = nullptr;
        std::map<std::uint32_t, Bound> bound; ///< by binding; more than the program binds may be there
        VkExtent3D groups{};
        const Handle* indirect = nullptr; ///< in place of groups
        VkDeviceSize indirectOffset = 0;
        std::uint32_t pushed = 0;
    };

    explicit TrackedDevice(Gpu& gpu);
    ~TrackedDevice();
    TrackedDevice(const TrackedDevice&) = delete;

    Handle createBuffer(VkDeviceSize size, VkBufferUsageFlags usage);
    /// A buffer's contents, while no dispatch reads them.
    std::span<std::byte> contents(Handle buffer) const { return resources_[buffer].mapped; }
    Handle createImage(VkFormat format, VkExtent2D extent, bool array);
    /// An image of somebody else's: in the general layout, or in that of sampled images.
    Handle import(const GpuImage& image);
    /// Constants by id.
    Program createProgram(std::span<const std::uint32_t> spirv, std::span<const Slot> slots,
                          const std::map<std::uint32_t, VkBool32>& constants);

    void begin(VkCommandBuffer commands);
    void dispatch(const Dispatch& dispatch);
    std::uint32_t barrierCount = 0; ///< so far

private:
    struct Resource {
        VkBuffer buffer = VK_NULL_HANDLE;
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        std::span<std::byte> mapped;
        std::uint32_t layers = 1;
        bool isImported = false;
        States states = StateUnknown;
    };
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::byte* mapped = nullptr;
        VkDeviceSize used = 0;
    };
    struct Place {
        VkDeviceMemory memory;
        VkDeviceSize offset;
        std::byte* mapped;
    };
    Place place(const VkMemoryRequirements& requirements);
    void require(std::span<const std::pair<Handle, States>> wanted);
    VkDescriptorSet createSet(const Dispatch& dispatch);

    Gpu& gpu_;
    std::vector<Resource> resources_;
    std::map<std::uint32_t, std::vector<Block>> blocks_; ///< by memory type
    std::vector<Program> programs_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

} // namespace nacre::tests
