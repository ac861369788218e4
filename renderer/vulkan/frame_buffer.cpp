#include "renderer/vulkan/frame_buffer.hpp"

#include <algorithm>
#include <cstring>

namespace nacre::renderer {
namespace {

std::uint64_t strideOf(const Gpu& gpu, std::uint64_t bytes) {
    const std::uint64_t alignment = std::max(
        {gpu.limits.minUniformBufferOffsetAlignment, gpu.limits.minStorageBufferOffsetAlignment, vk::DeviceSize{16}});
    return (bytes + alignment - 1) / alignment * alignment;
}

} // namespace

FrameBuffer::FrameBuffer(Gpu& gpu, const std::string& name, std::uint64_t bytes, vk::BufferUsageFlags usage,
                         std::uint32_t frames, Buffer::Place place)
    : buffer_(gpu, name, strideOf(gpu, bytes) * frames, usage, place),
      bytes_(bytes),
      stride_(strideOf(gpu, bytes)),
      frames_(frames) {}

void FrameBuffer::write(std::uint32_t frame, std::span<const std::byte> bytes) {
    if (!bytes.empty()) {
        std::memcpy(mapped(frame), bytes.data(), bytes.size());
    }
}

} // namespace nacre::renderer
