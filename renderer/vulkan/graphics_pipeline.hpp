// Pipelines that draw triangles. Internal to the renderer.
#pragma once

#include "renderer/vulkan/reloadable_pipeline.hpp"

#include <span>
#include <string>
#include <vector>

namespace nacre::renderer {

/// A pipeline for dynamic rendering: triangles, reversed depth. Viewport, scissor, cull mode and front
/// face are dynamic.
struct GraphicsPipelineInfo {
    std::string name;
    EmbeddedShader vertexShader;
    EmbeddedShader fragmentShader;
    std::vector<vk::VertexInputBindingDescription> vertexBindings;
    std::vector<vk::VertexInputAttributeDescription> vertexAttributes;
    std::vector<vk::Format> colorFormats;
    bool alphaMask = false; ///< specialisation constant 0 of the fragment shader
    /// Draws at the very depths that are there, under the colours that are: alpha times radiance, nearest first.
    bool under = false;
    vk::PipelineLayout layout;
};

ReloadablePipeline makeGraphicsPipeline(Gpu& gpu, const GraphicsPipelineInfo& info);

/// The layout of pipelines whose shaders read sets of these layouts and `pushBytes` bytes of push constants.
vk::raii::PipelineLayout makeGraphicsLayout(const Gpu& gpu, std::span<const vk::DescriptorSetLayout> setLayouts,
                                            std::uint32_t pushBytes);

/// Viewport and scissor over the whole attachment.
void setWholeViewport(const vk::raii::CommandBuffer& commandBuffer, vk::Extent2D extent);

} // namespace nacre::renderer
