#include "renderer/vulkan/resources.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

namespace nacre::renderer {
namespace {

std::optional<std::uint32_t> findMemoryType(const Gpu& gpu, std::uint32_t allowed, vk::MemoryPropertyFlags needed) {
    for (std::uint32_t i = 0; i < gpu.memoryProperties.memoryTypeCount; ++i) {
        if ((allowed >> i & 1u) != 0 && (gpu.memoryProperties.memoryTypes[i].propertyFlags & needed) == needed) {
            return i;
        }
    }
    return std::nullopt;
}

// With `wanted` too if the device has such memory.
std::uint32_t chooseMemoryType(const Gpu& gpu, std::uint32_t allowed, vk::MemoryPropertyFlags needed,
                               vk::MemoryPropertyFlags wanted, const std::string& what) {
    for (const vk::MemoryPropertyFlags flags : {needed | wanted, needed}) {
        if (const auto type = findMemoryType(gpu, allowed, flags)) {
            return *type;
        }
    }
    throw RendererError("the Vulkan device has no memory that suits the " + what);
}

[[noreturn]] void throwNoRoom(const std::string& what, std::uint64_t bytes, std::uint64_t used, std::uint64_t size) {
    throw RendererError("there is not enough device memory: the " + what + " needs " + readableBytes(bytes) + ", and " +
                        readableBytes(used) + " of " + readableBytes(size) + " are taken");
}

/// Throws RendererError when the device cannot make such an image.
void checkLimits(const Gpu& gpu, const vk::ImageCreateInfo& info, const std::string& name) {
    vk::ImageFormatProperties limits;
    try {
        limits = gpu.physicalDevice.getImageFormatProperties(info.format, info.imageType, info.tiling, info.usage,
                                                             info.flags);
    } catch (const vk::FormatNotSupportedError&) {
        throw RendererError("the Vulkan device has no images of format " + vk::to_string(info.format) +
                            " that can be what the " + name + " has to be");
    }
    const std::string size = std::to_string(info.extent.width) + "x" + std::to_string(info.extent.height) +
                             " pixels in " + std::to_string(info.arrayLayers) + " layers";
    if (info.extent.width > limits.maxExtent.width || info.extent.height > limits.maxExtent.height ||
        info.arrayLayers > limits.maxArrayLayers) {
        throw RendererError("the " + name + " of " + size + " is beyond the Vulkan device's limits of " +
                            std::to_string(limits.maxExtent.width) + "x" + std::to_string(limits.maxExtent.height) +
                            " in " + std::to_string(limits.maxArrayLayers));
    }
    const std::uint64_t bytes =
        std::uint64_t{pixelBytes(info.format)} * info.extent.width * info.extent.height * info.arrayLayers;
    if (bytes > limits.maxResourceSize) {
        throw RendererError("the " + name + " of " + size + " needs " + readableBytes(bytes) +
                            " of memory, more than the Vulkan device's limit of " +
                            readableBytes(limits.maxResourceSize) + " for one image");
    }
}

vk::MemoryPropertyFlags wantedProperties(Buffer::Place place) {
    switch (place) {
    case Buffer::Place::Constants:
        return vk::MemoryPropertyFlagBits::eDeviceLocal;
    case Buffer::Place::ReadBack:
        return vk::MemoryPropertyFlagBits::eHostCached;
    default:
        return {};
    }
}

} // namespace

Memory::Memory(Gpu& gpu, const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags needed,
               const std::string& what, vk::MemoryPropertyFlags wanted)
    : bytes_(requirements.size) {
    const std::uint32_t type = chooseMemoryType(gpu, requirements.memoryTypeBits, needed, wanted, what);
    const std::uint32_t heap = gpu.memoryProperties.memoryTypes[type].heapIndex;
    const std::uint64_t heapBytes = gpu.memoryProperties.memoryHeaps[heap].size;
    std::uint64_t& used = gpu.allocatedBytes[heap];
    // Software devices hand out more than they have and are killed later, so the heap's size is checked here.
    if (bytes_ > heapBytes || used > heapBytes - bytes_) {
        throwNoRoom(what, bytes_, used, heapBytes);
    }
    try {
        memory_ = vk::raii::DeviceMemory(gpu.device, {.allocationSize = bytes_, .memoryTypeIndex = type});
    } catch (const vk::SystemError&) {
        throwNoRoom(what, bytes_, used, heapBytes);
    }
    counter_ = &used;
    used += bytes_;
    ++gpu.allocations;
}

Memory::~Memory() {
    if (counter_) {
        *counter_ -= bytes_;
    }
}

Memory::Memory(Memory&& other) noexcept
    : memory_(std::move(other.memory_)), counter_(std::exchange(other.counter_, nullptr)), bytes_(other.bytes_) {}

Memory& Memory::operator=(Memory&& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(counter_, other.counter_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

Buffer::Buffer(Gpu& gpu, const std::string& name, std::uint64_t bytes, vk::BufferUsageFlags usage, Place place)
    : bytes_(bytes) {
    using Property = vk::MemoryPropertyFlagBits;
    const vk::MemoryPropertyFlags host = Property::eHostVisible | Property::eHostCoherent;
    buffer_ = vk::raii::Buffer(gpu.device, {.size = bytes, .usage = usage});
    gpu.name(buffer_, name);
    memory_ = Memory(gpu, buffer_.getMemoryRequirements(), place == Place::Device ? Property::eDeviceLocal : host, name,
                     wantedProperties(place));
    buffer_.bindMemory(*memory_.handle(), 0);
    if (place != Place::Device) {
        mapped_ = static_cast<std::byte*>(memory_.handle().mapMemory(0, VK_WHOLE_SIZE));
    }
}

bool Usage::writes() const {
    using Access = vk::AccessFlagBits2;
    return static_cast<bool>(access & (Access::eShaderWrite | Access::eMemoryWrite | Access::eColorAttachmentWrite |
                                       Access::eDepthStencilAttachmentWrite | Access::eTransferWrite));
}

Image::Image(Gpu& gpu, const ImageInfo& info) : info_(info) {
    const vk::ImageCreateInfo create{.flags = info.viewType == vk::ImageViewType::eCube
                                                  ? vk::ImageCreateFlagBits::eCubeCompatible
                                                  : vk::ImageCreateFlags{},
                                     .imageType = vk::ImageType::e2D,
                                     .format = info.format,
                                     .extent = {.width = info.extent.width, .height = info.extent.height, .depth = 1},
                                     .mipLevels = info.mipLevels,
                                     .arrayLayers = info.layers,
                                     .samples = vk::SampleCountFlagBits::e1,
                                     .tiling = vk::ImageTiling::eOptimal,
                                     .usage = info.usage};
    checkLimits(gpu, create, info.name);
    image_ = vk::raii::Image(gpu.device, create);
    gpu.name(image_, info.name);
    memory_ = Memory(gpu, image_.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal, info.name);
    image_.bindMemory(*memory_.handle(), 0);
    view_ = vk::raii::ImageView(
        gpu.device, {.image = *image_, .viewType = info.viewType, .format = info.format, .subresourceRange = range()});
}

vk::ImageAspectFlags Image::aspect() const {
    return info_.format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

vk::ImageSubresourceRange Image::range() const {
    return {.aspectMask = aspect(), .levelCount = info_.mipLevels, .layerCount = info_.layers};
}

vk::raii::ImageView Image::makeView(const Gpu& gpu, vk::ImageViewType type, std::uint32_t mipLevel,
                                    std::uint32_t firstLayer, std::uint32_t layerCount) const {
    return {gpu.device,
            {.image = *image_,
             .viewType = type,
             .format = info_.format,
             .subresourceRange = {.aspectMask = aspect(),
                                  .baseMipLevel = mipLevel,
                                  .levelCount = 1,
                                  .baseArrayLayer = firstLayer,
                                  .layerCount = layerCount}}};
}

vk::raii::ImageView Image::makeChannelView(const Gpu& gpu, vk::ComponentSwizzle channel) const {
    return {gpu.device,
            {.image = *image_,
             .viewType = info_.viewType,
             .format = info_.format,
             .components = {.r = channel},
             .subresourceRange = range()}};
}

void Image::forget() {
    lastUsage_ = {vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
                  vk::ImageLayout::eUndefined};
}

vk::ImageMemoryBarrier2 barrierBetween(vk::Image image, const vk::ImageSubresourceRange& range, const Usage& from,
                                       const Usage& to) {
    return {.srcStageMask = from.stages,
            .srcAccessMask = from.access,
            .dstStageMask = to.stages,
            .dstAccessMask = to.access,
            .oldLayout = from.layout,
            .newLayout = to.layout,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image,
            .subresourceRange = range};
}

void Image::prepare(const Usage& next, std::vector<vk::ImageMemoryBarrier2>& barriers) {
    const bool covered = (lastUsage_.stages & next.stages) == next.stages &&
                         (lastUsage_.access & next.access) == next.access && lastUsage_.layout == next.layout;
    if (covered && !lastUsage_.writes() && !next.writes()) {
        return;
    }
    barriers.push_back(barrierBetween(*image_, range(), lastUsage_, next));
    const bool readAgain = !lastUsage_.writes() && !next.writes() && lastUsage_.layout == next.layout;
    // Readers add up: a later write waits for all of them.
    lastUsage_ =
        readAgain ? Usage{lastUsage_.stages | next.stages, lastUsage_.access | next.access, next.layout} : next;
}

void prepare(const vk::raii::CommandBuffer& commandBuffer, std::span<const ImageUse> uses) {
    std::vector<vk::ImageMemoryBarrier2> barriers;
    for (const ImageUse& use : uses) {
        use.image.prepare(use.usage, barriers);
    }
    if (!barriers.empty()) {
        commandBuffer.pipelineBarrier2({.imageMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
                                        .pImageMemoryBarriers = barriers.data()});
    }
}

void prepare(const vk::raii::CommandBuffer& commandBuffer, std::initializer_list<ImageUse> uses) {
    prepare(commandBuffer, std::span(uses.begin(), uses.size()));
}

} // namespace nacre::renderer
