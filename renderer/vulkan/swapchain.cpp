#include "renderer/vulkan/swapchain.hpp"

#include "renderer/vulkan/translate_errors.hpp"

#include <algorithm>
#include <limits>

namespace nacre::renderer {
namespace {

constexpr std::uint32_t anyExtent = std::numeric_limits<std::uint32_t>::max();

/// Values that are written as they are: the picture is sRGB encoded already.
vk::SurfaceFormatKHR chooseFormat(const std::vector<vk::SurfaceFormatKHR>& formats) {
    for (const vk::SurfaceFormatKHR& format : formats) {
        if (format.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear &&
            (format.format == vk::Format::eB8G8R8A8Unorm || format.format == vk::Format::eR8G8B8A8Unorm)) {
            return format;
        }
    }
    throw RendererError("the window takes no 8-bit sRGB pictures from the Vulkan device");
}

vk::CompositeAlphaFlagBitsKHR chooseAlpha(vk::CompositeAlphaFlagsKHR supported) {
    using Alpha = vk::CompositeAlphaFlagBitsKHR;
    for (const Alpha alpha : {Alpha::eOpaque, Alpha::eInherit, Alpha::ePreMultiplied, Alpha::ePostMultiplied}) {
        if (supported & alpha) {
            return alpha;
        }
    }
    return Alpha::eOpaque;
}

/// Runs `action`, and says of what it throws that the window is concerned.
template <typename Action> auto translateWindowErrors(const Action& action) {
    try {
        return translateErrors(action);
    } catch (const DeviceLost&) {
        throw;
    } catch (const RendererError& error) {
        throw RendererError(std::string("the window cannot show pictures: ") + error.what());
    }
}

} // namespace

std::vector<std::string> Swapchain::deviceExtensions() {
    return {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
}

Swapchain::Swapchain(Gpu& gpu, vk::SurfaceKHR surface) : gpu_(gpu), surface_(surface) {
    translateErrors([&] {
        if (!gpu.physicalDevice.getSurfaceSupportKHR(gpu.queueFamily, surface)) {
            throw RendererError("the Vulkan device '" + gpu.description.name + "' cannot show pictures in a window");
        }
        format_ = chooseFormat(gpu.physicalDevice.getSurfaceFormatsKHR(surface));
        swapped_ = format_.format == vk::Format::eB8G8R8A8Unorm;
    });
}

bool Swapchain::rebuild(vk::Extent2D wanted) {
    return translateWindowErrors([&] {
        const vk::SurfaceCapabilitiesKHR can = gpu_.physicalDevice.getSurfaceCapabilitiesKHR(surface_);
        vk::Extent2D extent = can.currentExtent;
        if (extent.width == anyExtent) {
            extent.width = std::clamp(wanted.width, can.minImageExtent.width, can.maxImageExtent.width);
            extent.height = std::clamp(wanted.height, can.minImageExtent.height, can.maxImageExtent.height);
        }
        if (!(can.supportedUsageFlags & vk::ImageUsageFlagBits::eTransferDst)) {
            throw RendererError("the window's images cannot be copied to");
        }
        vk::SwapchainKHR old;
        if (current_) {
            retired_.push_back(std::move(*current_));
            current_.reset();
            old = *retired_.back().swapchain;
        }
        if (extent.width == 0 || extent.height == 0) {
            return false;
        }
        const std::uint32_t most = can.maxImageCount == 0 ? anyExtent : can.maxImageCount;
        Images images;
        images.extent = extent;
        images.swapchain = vk::raii::SwapchainKHR(
            gpu_.device, vk::SwapchainCreateInfoKHR{.surface = surface_,
                                                    .minImageCount = std::min(can.minImageCount + 1, most),
                                                    .imageFormat = format_.format,
                                                    .imageColorSpace = format_.colorSpace,
                                                    .imageExtent = extent,
                                                    .imageArrayLayers = 1,
                                                    .imageUsage = vk::ImageUsageFlagBits::eTransferDst,
                                                    .preTransform = can.currentTransform,
                                                    .compositeAlpha = chooseAlpha(can.supportedCompositeAlpha),
                                                    .presentMode = vk::PresentModeKHR::eFifo,
                                                    .clipped = VK_TRUE,
                                                    .oldSwapchain = old});
        for (const VkImage image : images.swapchain.getImages()) {
            images.images.emplace_back(image);
            images.finished.emplace_back(gpu_.device, vk::SemaphoreCreateInfo{});
        }
        current_ = std::move(images);
        return true;
    });
}

std::optional<Swapchain::Acquired> Swapchain::acquire(vk::Semaphore free) {
    return translateWindowErrors([&]() -> std::optional<Acquired> {
        try {
            const auto [result, index] = current_->swapchain.acquireNextImage(0, free);
            if (result != vk::Result::eSuccess && result != vk::Result::eSuboptimalKHR) {
                return std::nullopt;
            }
            return Acquired{index, current_->images[index], *current_->finished[index]};
        } catch (const vk::OutOfDateKHRError&) {
            retired_.push_back(std::move(*current_));
            current_.reset();
            return std::nullopt;
        }
    });
}

void Swapchain::present(const Acquired& image) {
    translateWindowErrors([&] {
        const vk::SwapchainKHR swapchain = *current_->swapchain;
        try {
            static_cast<void>(gpu_.queue.presentKHR({.waitSemaphoreCount = 1,
                                                     .pWaitSemaphores = &image.finished,
                                                     .swapchainCount = 1,
                                                     .pSwapchains = &swapchain,
                                                     .pImageIndices = &image.index}));
        } catch (const vk::OutOfDateKHRError&) {
            retired_.push_back(std::move(*current_));
            current_.reset();
        }
    });
}

} // namespace nacre::renderer
