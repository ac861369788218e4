// Debug labels around what is recorded, for captures. Internal to the renderer.
#pragma once

#include "renderer/vulkan/open_device.hpp"

#include <string>

namespace nacre::renderer {

/// Opens a debug label and closes it at the end of the scope.
class Label {
public:
    Label(const Gpu& gpu, const vk::raii::CommandBuffer& commandBuffer, const std::string& text)
        : commandBuffer_(gpu.labels ? &commandBuffer : nullptr) {
        if (commandBuffer_) {
            commandBuffer_->beginDebugUtilsLabelEXT({.pLabelName = text.c_str()});
        }
    }
    ~Label() {
        if (commandBuffer_) {
            commandBuffer_->endDebugUtilsLabelEXT();
        }
    }
    Label(const Label&) = delete;
    Label& operator=(const Label&) = delete;

private:
    const vk::raii::CommandBuffer* commandBuffer_ = nullptr;
};

} // namespace nacre::renderer
