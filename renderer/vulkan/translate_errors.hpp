// What Vulkan throws, as sentences. Internal to the renderer.
#pragma once

#include "renderer/graphics_device.hpp"
#include "renderer/vulkan/vulkan.hpp"

namespace nacre::renderer {

/// Runs `action` and turns what Vulkan throws into RendererError.
template <typename Action> auto translateErrors(const Action& action) {
    try {
        return action();
    } catch (const vk::OutOfDeviceMemoryError&) {
        throw RendererError("the Vulkan device has run out of memory");
    } catch (const vk::OutOfHostMemoryError&) {
        throw RendererError("there is not enough memory for the Vulkan driver");
    } catch (const vk::DeviceLostError&) {
        throw DeviceLost();
    } catch (const vk::SystemError& error) {
        throw RendererError(std::string("a Vulkan call failed: ") + error.what());
    }
}

} // namespace nacre::renderer
