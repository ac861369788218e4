// What an open device consists of. Internal to the renderer.
#pragma once

#include "renderer/graphics_device.hpp"
#include "renderer/vulkan/vulkan.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace nacre::renderer {

struct PipelineRecipe;

/// An open device, its one queue (graphics, compute, transfer) and what was asked of it.
struct Device::Implementation {
    explicit Implementation(const DeviceSettings& settings);

    vk::raii::Context context;
    std::vector<std::string> validationMessages;
    vk::raii::Instance instance = nullptr;
    vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
    vk::raii::PhysicalDevice physicalDevice = nullptr;
    DeviceDescription description;
    vk::PhysicalDeviceLimits limits;
    vk::PhysicalDeviceMemoryProperties memoryProperties;
    bool labels = false;      ///< VK_EXT_debug_utils is there
    bool anisotropic = false; ///< samplerAnisotropy is there and enabled
    bool halfFloats = false;  ///< shaderFloat16 is there and enabled
    std::uint32_t queueFamily = 0;
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
    vk::raii::CommandPool commandPool = nullptr;
    vk::raii::PipelineCache pipelineCache = nullptr;      ///< of everything that is compiled, so that nothing is twice
    std::vector<std::weak_ptr<PipelineRecipe>> pipelines; ///< renderer/vulkan/reloadable_pipeline.hpp
    /// Bytes allocated through Memory (renderer/vulkan/resources.hpp), per heap.
    std::vector<std::uint64_t> allocatedBytes;
    std::uint64_t allocations = 0; ///< made so, also those that are gone

    /// Records with `recorder`, submits and waits.
    void submitAndWait(const std::function<void(const vk::raii::CommandBuffer&)>& recorder);

    /// Names an object in validation messages and captures.
    template <typename Handle> void name(const Handle& handle, const std::string& text) const {
        if (labels) {
            setName(Handle::objectType, reinterpret_cast<std::uint64_t>(static_cast<typename Handle::CType>(*handle)),
                    text);
        }
    }

private:
    void setName(vk::ObjectType type, std::uint64_t handle, const std::string& text) const;
};

using Gpu = Device::Implementation;

/// "12.5 MiB": for sentences.
std::string readableBytes(std::uint64_t bytes);

} // namespace nacre::renderer
