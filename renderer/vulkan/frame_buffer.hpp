// Constants that change from frame to frame. Internal to the renderer.
#pragma once

#include "renderer/vulkan/resources.hpp"

#include <span>

namespace nacre::renderer {

/// A buffer with a copy for each frame in flight: the host writes one while the device reads others.
class FrameBuffer {
public:
    FrameBuffer() = default;
    /// `bytes` [> 0] of one copy.
    FrameBuffer(Gpu& gpu, const std::string& name, std::uint64_t bytes, vk::BufferUsageFlags usage,
                std::uint32_t frames, Buffer::Place place = Buffer::Place::Constants);

    /// Fills the copy's beginning. The device must have finished with what was recorded with it.
    void write(std::uint32_t frame, std::span<const std::byte> bytes);
    /// Where the host sees the copy.
    std::byte* mapped(std::uint32_t frame) const { return buffer_.mapped() + frame * stride_; }
    vk::DescriptorBufferInfo copy(std::uint32_t frame) const {
        return {.buffer = buffer_.handle(), .offset = frame * stride_, .range = bytes_};
    }
    std::uint32_t frames() const { return frames_; }

private:
    Buffer buffer_;
    std::uint64_t bytes_ = 0;
    std::uint64_t stride_ = 0; ///< from copy to copy
    std::uint32_t frames_ = 0;
};

} // namespace nacre::renderer
