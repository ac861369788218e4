// Buffers and images with their memory, and the barriers between their uses. Internal to the renderer.
#pragma once

#include "renderer/vulkan/open_device.hpp"

#include <initializer_list>
#include <span>

namespace nacre::renderer {

/// One dedicated allocation, counted against its heap.
class Memory {
public:
    Memory() = default;
    /// With the properties `needed`, and those `wanted` if there is such memory. Throws RendererError naming `what` and
    /// its size when the heap has no room for it.
    Memory(Gpu& gpu, const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags needed,
           const std::string& what, vk::MemoryPropertyFlags wanted = {});
    ~Memory();
    Memory(Memory&& other) noexcept;
    Memory& operator=(Memory&& other) noexcept;

    const vk::raii::DeviceMemory& handle() const { return memory_; }

private:
    vk::raii::DeviceMemory memory_ = nullptr;
    std::uint64_t* counter_ = nullptr;
    std::uint64_t bytes_ = 0;
};

/// A buffer; `mapped` is null unless it is visible to the host.
class Buffer {
public:
    enum class Place {
        Device,
        Host,      ///< for the host to write
        Constants, ///< for the host to write and for passes to read: on the device where it has such memory
        ReadBack   ///< for the host to read: cached where the device has such memory
    };

    Buffer() = default;
    Buffer(Gpu& gpu, const std::string& name, std::uint64_t bytes, vk::BufferUsageFlags usage, Place place);

    vk::Buffer handle() const { return *buffer_; }
    std::uint64_t bytes() const { return bytes_; }
    std::byte* mapped() const { return mapped_; }

private:
    Memory memory_;
    vk::raii::Buffer buffer_ = nullptr;
    std::uint64_t bytes_ = 0;
    std::byte* mapped_ = nullptr;
};

/// What a pass does with an image.
struct Usage {
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 access;
    vk::ImageLayout layout = vk::ImageLayout::eUndefined;

    bool writes() const;
};

namespace usage {
using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

inline const Usage colorAttachment{Stage::eColorAttachmentOutput,
                                   Access::eColorAttachmentRead | Access::eColorAttachmentWrite,
                                   Layout::eColorAttachmentOptimal};
inline const Usage depthAttachment{Stage::eEarlyFragmentTests | Stage::eLateFragmentTests,
                                   Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite,
                                   Layout::eDepthAttachmentOptimal};
inline const Usage fragmentRead{Stage::eFragmentShader, Access::eShaderRead, Layout::eShaderReadOnlyOptimal};
inline const Usage computeRead{Stage::eComputeShader, Access::eShaderRead, Layout::eShaderReadOnlyOptimal};
inline const Usage computeWrite{Stage::eComputeShader, Access::eShaderWrite, Layout::eGeneral};
inline const Usage transferRead{Stage::eTransfer, Access::eTransferRead, Layout::eTransferSrcOptimal};
inline const Usage transferWrite{Stage::eTransfer, Access::eTransferWrite, Layout::eTransferDstOptimal};
} // namespace usage

struct ImageInfo {
    std::string name;
    vk::Format format = vk::Format::eUndefined;
    vk::Extent2D extent;
    vk::ImageUsageFlags usage;
    std::uint32_t layers = 1;
    std::uint32_t mipLevels = 1;
    /// The kind of the whole image's view.
    vk::ImageViewType viewType = vk::ImageViewType::e2D;
};

/// An image, a view of all of it, and what it was last used for: in the order of recording, which must be the order in
/// which one queue gets it.
class Image {
public:
    Image() = default;
    Image(Gpu& gpu, const ImageInfo& info);

    const ImageInfo& info() const { return info_; }
    vk::Image handle() const { return *image_; }
    vk::ImageView view() const { return *view_; }
    vk::ImageAspectFlags aspect() const;
    vk::ImageSubresourceRange range() const;
    /// A view of one mip level and some layers.
    vk::raii::ImageView makeView(const Gpu& gpu, vk::ImageViewType type, std::uint32_t mipLevel,
                                 std::uint32_t firstLayer, std::uint32_t layerCount) const;
    /// A view of the whole image in which one channel is red.
    vk::raii::ImageView makeChannelView(const Gpu& gpu, vk::ComponentSwizzle channel) const;
    const Usage& lastUsage() const { return lastUsage_; }

    /// Makes the image ready for `next`; the barrier needed is appended to `barriers`. Order of calls is order of use.
    void prepare(const Usage& next, std::vector<vk::ImageMemoryBarrier2>& barriers);
    /// Says that a barrier recorded elsewhere brought the image here.
    void assume(const Usage& current) { lastUsage_ = current; }
    /// Says that what was recorded last with the image will not be submitted: its content is lost.
    void forget();

private:
    ImageInfo info_;
    Memory memory_;
    vk::raii::Image image_ = nullptr;
    vk::raii::ImageView view_ = nullptr;
    Usage lastUsage_;
};

struct ImageUse {
    Image& image;
    const Usage& usage;
};

/// The barrier between two uses of an image.
vk::ImageMemoryBarrier2 barrierBetween(vk::Image image, const vk::ImageSubresourceRange& range, const Usage& from,
                                       const Usage& to);

/// One pipeline barrier that makes all these images ready.
void prepare(const vk::raii::CommandBuffer& commandBuffer, std::initializer_list<ImageUse> uses);
void prepare(const vk::raii::CommandBuffer& commandBuffer, std::span<const ImageUse> uses);

/// Bytes per pixel of the formats the renderer and the benchmark use.
std::uint32_t pixelBytes(vk::Format format);

} // namespace nacre::renderer
