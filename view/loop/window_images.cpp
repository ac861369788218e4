#include "view/loop/window_images.hpp"

namespace nacre::view {
namespace {

void recordBarrier(const vk::raii::CommandBuffer& commands, vk::Image image, const renderer::Usage& from,
                   const renderer::Usage& to) {
    const auto barrier = renderer::barrierBetween(image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}, from, to);
    commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

} // namespace

WindowImages::WindowImages(renderer::Gpu& gpu, vk::SurfaceKHR surface, std::function<vk::Extent2D()> extent)
    : swapchain_(gpu, surface), windowExtent_(std::move(extent)) {
    rebuild();
}

bool WindowImages::rebuild() {
    presented_ = 0;
    return swapchain_.rebuild(windowExtent_());
}

void WindowImages::releaseRetired(std::size_t framesInFlight) {
    if (presented_ > framesInFlight) {
        swapchain_.releaseRetired();
    }
}

void WindowImages::record(const vk::raii::CommandBuffer& commands, std::uint32_t index,
                          renderer::Accumulation& accumulation, const renderer::ShowLook& look, const Image& image) {
    const vk::Extent2D size = extent();
    accumulation.recordShow(commands, index, size, look, swapchain_.isSwapped());
    // The semaphore is waited for by transfers, so that this barrier follows it.
    const renderer::Usage before{vk::PipelineStageFlagBits2::eTransfer, {}, vk::ImageLayout::eUndefined};
    const renderer::Usage after{vk::PipelineStageFlagBits2::eTransfer, {}, vk::ImageLayout::ePresentSrcKHR};
    recordBarrier(commands, image.image, before, renderer::usage::transferWrite);
    commands.copyBufferToImage(accumulation.pixels(), image.image, vk::ImageLayout::eTransferDstOptimal,
                               vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                                   .imageExtent = {size.width, size.height, 1}});
    recordBarrier(commands, image.image, renderer::usage::transferWrite, after);
}

void WindowImages::present(const Image& image) {
    ++presented_;
    swapchain_.present(image);
}

} // namespace nacre::view
