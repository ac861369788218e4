// Reads a frame's images back as floats. Internal to the renderer.
#pragma once

#include "renderer/passes/compose.hpp"
#include "renderer/renderer.hpp"

#include <utility>

namespace nacre::renderer {

struct FrameImages {
    GBuffer& gbuffer;
    Lighting& lighting;
    Subsurface& subsurface;
    Compose& compose;
    bool scatter = true;
    bool transmit = true;
};

Pixels readOutput(Gpu& gpu, Output output, const FrameImages& images);

/// Runs `action` and turns what Vulkan throws into RendererError.
template <typename Action> void guard(const Action& action) {
    try {
        action();
    } catch (const vk::OutOfDeviceMemoryError&) {
        throw RendererError("the Vulkan device has run out of memory");
    } catch (const vk::OutOfHostMemoryError&) {
        throw RendererError("there is not enough memory for the Vulkan driver");
    } catch (const vk::SystemError& error) {
        throw RendererError(std::string("a Vulkan call failed: ") + error.what());
    }
}

} // namespace nacre::renderer
