// Images of a window's surface. Internal to whoever drives frames in a window.
#pragma once

#include "renderer/vulkan/open_device.hpp"

#include <optional>
#include <vector>

namespace nacre::renderer {

class Swapchain {
public:
    /// What a device has to have for it.
    static std::vector<std::string> deviceExtensions();

    /// Throws RendererError where the device cannot show pictures on the surface, which stays its owner's.
    Swapchain(Gpu& gpu, vk::SurfaceKHR surface);

    /// Makes the images anew in the surface's size, or in `wanted` where it takes any. Frames in flight may still use
    /// the old ones, which stay until `releaseRetired`. False where the window has no pixels, as a minimised one.
    bool rebuild(vk::Extent2D wanted);
    /// Destroys what was replaced. Everything that was submitted before the last rebuild must have finished.
    void releaseRetired() { retired_.clear(); }

    bool isUsable() const { return current_.has_value(); }
    vk::Extent2D extent() const { return current_->extent; }
    /// B G R A in place of R G B A.
    bool isSwapped() const { return swapped_; }

    struct Acquired {
        std::uint32_t index;
        vk::Image image;
        vk::Semaphore finished; ///< to be signalled when the image has been drawn
    };
    /// The next image, whose readers signal `free`. Nothing where none is to be had now, or the images no longer fit
    /// the window, which `isUsable` then says.
    std::optional<Acquired> acquire(vk::Semaphore free);
    void present(const Acquired& image);

private:
    struct Images {
        vk::raii::SwapchainKHR swapchain = nullptr;
        vk::Extent2D extent;
        std::vector<vk::Image> images;
        std::vector<vk::raii::Semaphore> finished; ///< one an image
    };

    Gpu& gpu_;
    vk::SurfaceKHR surface_;
    vk::SurfaceFormatKHR format_;
    bool swapped_ = false;
    std::optional<Images> current_;
    std::vector<Images> retired_;
};

} // namespace nacre::renderer
