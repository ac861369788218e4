// Moves bytes between the host and the device's buffers and images, and waits for them. Internal to the renderer.
#pragma once

#include "renderer/vulkan/resources.hpp"

#include <span>
#include <vector>

namespace nacre::renderer {

/// A device buffer filled with `bytes` (at least 16 bytes long, so that an empty one can be bound).
Buffer uploadBuffer(Gpu& gpu, const std::string& name, std::span<const std::byte> bytes, vk::BufferUsageFlags usage);
/// Fills mip level 0, layer after layer, and makes the other levels by halving; leaves the image ready for `next`.
void uploadImage(Gpu& gpu, Image& image, std::span<const std::byte> pixels, const Usage& next);
/// Mip level 0 of layer 0, rows packed.
std::vector<std::byte> downloadImage(Gpu& gpu, Image& image);

} // namespace nacre::renderer
