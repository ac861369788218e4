// The images of a window that the viewer's picture is shown in.
#pragma once

#include "renderer/accumulation.hpp"
#include "renderer/vulkan/swapchain.hpp"

#include <functional>
#include <optional>

namespace nacre::view {

class WindowImages {
public:
    using Image = renderer::Swapchain::Acquired;

    /// `extent` says the window's size in px. The surface stays its owner's.
    WindowImages(renderer::Gpu& gpu, vk::SurfaceKHR surface, std::function<vk::Extent2D()> extent);

    /// Makes the images anew in the window's size; false where it has no pixels.
    bool rebuild();
    bool isUsable() const { return swapchain_.isUsable(); }
    vk::Extent2D extent() const { return swapchain_.extent(); }
    /// Destroys the images that were replaced, once as many frames have followed as can be in flight.
    void releaseRetired(std::size_t framesInFlight);
    std::optional<Image> acquire(vk::Semaphore free) { return swapchain_.acquire(free); }
    /// Records what fills an image. Transfers are to wait for its readers.
    void record(const vk::raii::CommandBuffer& commands, std::uint32_t index, renderer::Accumulation& accumulation,
                const renderer::ShowLook& look, const Image& image);
    /// Shows an image whose commands were submitted.
    void present(const Image& image);

private:
    renderer::Swapchain swapchain_;
    std::function<vk::Extent2D()> windowExtent_;
    std::size_t presented_ = 0; ///< images since the last rebuild
};

} // namespace nacre::view
