#include "images.hpp"

#include "frame_block.hpp"

Images createImages(Device& device, VkExtent2D extent, VkSampleCountFlagBits samples) {
    constexpr std::uint32_t mapSize = 1024;
    constexpr VkImageUsageFlags color = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    constexpr VkImageUsageFlags depth = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    Images images;
    images.shadowMap = device.createImage(VK_FORMAT_D32_SFLOAT, {mapSize, mapSize}, depth, cascadeCount);
    images.drawn = {device.createImage(VK_FORMAT_R8G8B8A8_SRGB, extent, color, 0, samples),
                    device.createImage(VK_FORMAT_R16G16_SFLOAT, extent, color, 0, samples),
                    device.createImage(VK_FORMAT_D32_SFLOAT_S8_UINT, extent, depth, 0, samples)};
    if (samples != VK_SAMPLE_COUNT_1_BIT) {
        images.resolved = {device.createImage(VK_FORMAT_R8G8B8A8_SRGB, extent, color),
                           device.createImage(VK_FORMAT_R16G16_SFLOAT, extent, color),
                           device.createImage(VK_FORMAT_R32_SFLOAT, extent, color)};
        images.ids = device.createImage(VK_FORMAT_R8_UINT, extent, color);
    }
    images.irradiance = device.createImage(VK_FORMAT_R16G16B16A16_SFLOAT, extent, color);
    images.picture = device.createImage(VK_FORMAT_R8G8B8A8_SRGB, extent, color | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    return images;
}
