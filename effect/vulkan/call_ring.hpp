// The ring of descriptor sets and uniform memory: one of each per call and frame in flight.
#pragma once

#include "vulkan/objects.hpp"

#include <cstddef>
#include <vector>

namespace nacre::effect {

struct Context;

/// Descriptors and uniform memory of one call in one frame.
struct CallResources {
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkDescriptorBufferInfo parameters{};
    VkDescriptorBufferInfo lights{}; ///< transmit
    std::byte* mappedParameters = nullptr;
    std::byte* mappedLights = nullptr;
};

/// The calls of one kind (scatter, transmit or compose) in one frame.
struct FrameCalls {
    std::vector<CallResources> calls;
    std::uint32_t used = 0;
};

struct Frame {
    FrameCalls scatter;
    FrameCalls transmit;
    FrameCalls compose;
};

/// The uniform buffer of all frames, without memory.
Buffer createUniforms(const Context& context, std::uint32_t frameCount, std::uint32_t callsPerFrame);
/// Descriptor sets of all frames, and each one's part of the uniform buffer.
void createFrames(Context& context, std::uint32_t frameCount, std::uint32_t callsPerFrame);
/// The resources of a kind's next call; throws when the frame is not the one last begun or has none left. `info` is the
/// call's struct. They are used up once FrameCalls::used counts them.
CallResources& nextCall(Context& context, std::uint32_t frame, FrameCalls Frame::*kind, const char* info);

/// The frame that calls belong to. `info`: names the call where none was begun.
std::uint32_t begunFrame(const Context& context, const char* info);

} // namespace nacre::effect
