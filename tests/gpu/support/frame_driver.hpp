// Drives a frame as a window would: command buffers and fences of its own, a picture that is copied out of each.
#pragma once

#include "renderer/frame.hpp"
#include "renderer/vulkan/open_device.hpp"

#include <cstddef>
#include <vector>

namespace nacre::tests {

/// A frame's images as they lie in memory.
struct FramePicture {
    std::vector<std::byte> color;    ///< RGBA8
    std::vector<std::byte> radiance; ///< RGBA16F

    bool operator==(const FramePicture&) const = default;
};

class FrameDriver {
public:
    FrameDriver(renderer::Device& device, const scene::Scene& scene, const renderer::RenderSettings& settings,
                const renderer::FrameLimits& limits = {})
        : frame(device, scene, settings, limits),
          gpu_(device.implementation()),
          pool_(gpu_.device,
                {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = gpu_.queueFamily}),
          commandBuffers_(gpu_.device, {.commandPool = *pool_,
                                        .level = vk::CommandBufferLevel::ePrimary,
                                        .commandBufferCount = limits.framesInFlight}) {
        for (std::uint32_t i = 0; i < limits.framesInFlight; ++i) {
            fences_.emplace_back(gpu_.device, vk::FenceCreateInfo{});
        }
        makeCopies();
    }

    /// Records into the command buffer of this number, which must be free, without submitting it.
    void record(std::uint32_t index, const renderer::FrameView& view) {
        const vk::raii::CommandBuffer& commandBuffer = commandBuffers_[index];
        commandBuffer.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        frame.record(commandBuffer, index, view);
        copy(commandBuffer, frame.images().color, colors_[index]);
        copy(commandBuffer, frame.images().radiance, radiances_[index]);
        commandBuffer.end();
    }

    void submit(std::uint32_t index) {
        const vk::CommandBufferSubmitInfo commands{.commandBuffer = *commandBuffers_[index]};
        gpu_.queue.submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &commands},
                           *fences_[index]);
    }

    /// Waits until the device has finished the frame, and returns what it drew.
    FramePicture finish(std::uint32_t index) {
        if (gpu_.device.waitForFences(*fences_[index], VK_TRUE, ~std::uint64_t{0}) != vk::Result::eSuccess) {
            throw renderer::RendererError("the device did not finish");
        }
        gpu_.device.resetFences(*fences_[index]);
        return {bytes(colors_[index]), bytes(radiances_[index])};
    }

    FramePicture draw(const renderer::FrameView& view) {
        record(0, view);
        submit(0);
        return finish(0);
    }

    /// No frame may be in flight.
    void resize(std::uint32_t width, std::uint32_t height) {
        frame.resize(width, height);
        makeCopies();
    }

    renderer::Frame frame;

private:
    void makeCopies() {
        colors_.clear();
        radiances_.clear();
        for (std::size_t i = 0; i < fences_.size(); ++i) {
            colors_.push_back(makeCopy(frame.images().color));
            radiances_.push_back(makeCopy(frame.images().radiance));
        }
    }

    renderer::Buffer makeCopy(const renderer::Image& image) {
        const vk::Extent2D extent = image.info().extent;
        return {gpu_, "copy of a frame",
                std::uint64_t{extent.width} * extent.height * renderer::pixelBytes(image.info().format),
                vk::BufferUsageFlagBits::eTransferDst, renderer::Buffer::Place::ReadBack};
    }

    static void copy(const vk::raii::CommandBuffer& commandBuffer, renderer::Image& image,
                     const renderer::Buffer& buffer) {
        renderer::prepare(commandBuffer, {{image, renderer::usage::transferRead}});
        commandBuffer.copyImageToBuffer(
            image.handle(), vk::ImageLayout::eTransferSrcOptimal, buffer.handle(),
            vk::BufferImageCopy{.imageSubresource = {.aspectMask = image.aspect(), .layerCount = 1},
                                .imageExtent = {image.info().extent.width, image.info().extent.height, 1}});
        const vk::MemoryBarrier2 toHost{.srcStageMask = vk::PipelineStageFlagBits2::eTransfer,
                                        .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                        .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                        .dstAccessMask = vk::AccessFlagBits2::eHostRead};
        commandBuffer.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &toHost});
    }

    static std::vector<std::byte> bytes(const renderer::Buffer& buffer) {
        return {buffer.mapped(), buffer.mapped() + buffer.bytes()};
    }

    renderer::Gpu& gpu_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffers commandBuffers_;
    std::vector<vk::raii::Fence> fences_;
    std::vector<renderer::Buffer> colors_;
    std::vector<renderer::Buffer> radiances_;
};

} // namespace nacre::tests
