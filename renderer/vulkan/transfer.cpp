#include "renderer/vulkan/transfer.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace nacre::renderer {
namespace {

Buffer stage(Gpu& gpu, std::span<const std::byte> bytes) {
    Buffer staging(gpu, "staging buffer", std::max<std::size_t>(bytes.size(), 16),
                   vk::BufferUsageFlagBits::eTransferSrc, Buffer::Place::Host);
    std::memcpy(staging.mapped(), bytes.data(), bytes.size());
    return staging;
}

vk::BufferImageCopy mostDetailedLevel(const Image& image, std::uint32_t layers) {
    return {.imageSubresource = {.aspectMask = image.aspect(), .layerCount = layers},
            .imageExtent = {image.info().extent.width, image.info().extent.height, 1}};
}

vk::Offset3D corner(vk::Extent2D extent, std::uint32_t level) {
    return {static_cast<std::int32_t>(std::max(1u, extent.width >> level)),
            static_cast<std::int32_t>(std::max(1u, extent.height >> level)), 1};
}

/// Turns one mip level from a copy's destination into a copy's source.
void makeSource(const vk::raii::CommandBuffer& commandBuffer, const Image& image, std::uint32_t level) {
    const vk::ImageMemoryBarrier2 barrier{.srcStageMask = usage::transferWrite.stages,
                                          .srcAccessMask = usage::transferWrite.access,
                                          .dstStageMask = usage::transferRead.stages,
                                          .dstAccessMask = usage::transferRead.access,
                                          .oldLayout = usage::transferWrite.layout,
                                          .newLayout = usage::transferRead.layout,
                                          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .image = image.handle(),
                                          .subresourceRange = {image.aspect(), level, 1, 0, image.info().layers}};
    commandBuffer.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

/// Fills levels 1 … from level 0, each from the one above. All levels end as a copy's source.
void halve(const vk::raii::CommandBuffer& commandBuffer, const Image& image) {
    const ImageInfo& info = image.info();
    for (std::uint32_t level = 1; level < info.mipLevels; ++level) {
        makeSource(commandBuffer, image, level - 1);
        const vk::ImageBlit blit{.srcSubresource = {image.aspect(), level - 1, 0, info.layers},
                                 .srcOffsets = std::array{vk::Offset3D{}, corner(info.extent, level - 1)},
                                 .dstSubresource = {image.aspect(), level, 0, info.layers},
                                 .dstOffsets = std::array{vk::Offset3D{}, corner(info.extent, level)}};
        commandBuffer.blitImage(image.handle(), vk::ImageLayout::eTransferSrcOptimal, image.handle(),
                                vk::ImageLayout::eTransferDstOptimal, blit, vk::Filter::eLinear);
    }
    makeSource(commandBuffer, image, info.mipLevels - 1);
}

} // namespace

Buffer uploadBuffer(Gpu& gpu, const std::string& name, std::span<const std::byte> bytes, vk::BufferUsageFlags usage) {
    Buffer buffer(gpu, name, std::max<std::size_t>(bytes.size(), 16), usage | vk::BufferUsageFlagBits::eTransferDst,
                  Buffer::Place::Device);
    if (bytes.empty()) {
        return buffer;
    }
    const Buffer staging = stage(gpu, bytes);
    gpu.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        commandBuffer.copyBuffer(staging.handle(), buffer.handle(), vk::BufferCopy{.size = bytes.size()});
    });
    return buffer;
}

void uploadImage(Gpu& gpu, Image& image, std::span<const std::byte> pixels, const Usage& next) {
    const Buffer staging = stage(gpu, pixels);
    gpu.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        prepare(commandBuffer, {{image, usage::transferWrite}});
        commandBuffer.copyBufferToImage(staging.handle(), image.handle(), vk::ImageLayout::eTransferDstOptimal,
                                        mostDetailedLevel(image, image.info().layers));
        halve(commandBuffer, image);
        image.assume(usage::transferRead);
        prepare(commandBuffer, {{image, next}});
    });
}

std::vector<std::byte> downloadImage(Gpu& gpu, Image& image) {
    const vk::Extent2D extent = image.info().extent;
    const std::size_t bytes = std::size_t{extent.width} * extent.height * pixelBytes(image.info().format);
    const Buffer staging(gpu, "read-back buffer", bytes, vk::BufferUsageFlagBits::eTransferDst,
                         Buffer::Place::ReadBack);
    gpu.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        prepare(commandBuffer, {{image, usage::transferRead}});
        commandBuffer.copyImageToBuffer(image.handle(), vk::ImageLayout::eTransferSrcOptimal, staging.handle(),
                                        mostDetailedLevel(image, 1));
        const vk::MemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eTransfer,
                                         .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                         .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                         .dstAccessMask = vk::AccessFlagBits2::eHostRead};
        commandBuffer.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
    });
    return {staging.mapped(), staging.mapped() + bytes};
}

std::uint32_t pixelBytes(vk::Format format) {
    switch (format) {
    case vk::Format::eR8Uint:
        return 1;
    case vk::Format::eR16Uint:
    case vk::Format::eR16Sfloat:
        return 2;
    case vk::Format::eB10G11R11UfloatPack32:
    case vk::Format::eR32Sfloat:
    case vk::Format::eD32Sfloat:
    case vk::Format::eR8G8B8A8Unorm:
    case vk::Format::eR8G8B8A8Srgb:
        return 4;
    case vk::Format::eR16G16B16A16Sfloat:
        return 8;
    default:
        throw RendererError("the renderer has no images of format " + vk::to_string(format));
    }
}

} // namespace nacre::renderer
