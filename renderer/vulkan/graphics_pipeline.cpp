#include "renderer/vulkan/graphics_pipeline.hpp"

#include <array>

namespace nacre::renderer {
namespace {

vk::raii::Pipeline makePipeline(const Gpu& gpu, const GraphicsPipelineInfo& info) {
    const vk::raii::ShaderModule vertexShader = makeShaderModule(gpu, info.vertexShader);
    const vk::raii::ShaderModule fragmentShader = makeShaderModule(gpu, info.fragmentShader);
    const VkBool32 alphaMask = info.alphaMask;
    const vk::SpecializationMapEntry entry{.constantID = 0, .offset = 0, .size = sizeof alphaMask};
    const vk::SpecializationInfo specialization{
        .mapEntryCount = 1, .pMapEntries = &entry, .dataSize = sizeof alphaMask, .pData = &alphaMask};
    const std::array stages{vk::PipelineShaderStageCreateInfo{
                                .stage = vk::ShaderStageFlagBits::eVertex, .module = *vertexShader, .pName = "main"},
                            vk::PipelineShaderStageCreateInfo{.stage = vk::ShaderStageFlagBits::eFragment,
                                                              .module = *fragmentShader,
                                                              .pName = "main",
                                                              .pSpecializationInfo = &specialization}};
    const vk::PipelineVertexInputStateCreateInfo vertexInput{
        .vertexBindingDescriptionCount = static_cast<std::uint32_t>(info.vertexBindings.size()),
        .pVertexBindingDescriptions = info.vertexBindings.data(),
        .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(info.vertexAttributes.size()),
        .pVertexAttributeDescriptions = info.vertexAttributes.data()};
    const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = vk::PrimitiveTopology::eTriangleList};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationStateCreateInfo rasterization{.lineWidth = 1};
    const vk::PipelineMultisampleStateCreateInfo multisample{.rasterizationSamples = vk::SampleCountFlagBits::e1};
    const vk::PipelineDepthStencilStateCreateInfo depth{.depthTestEnable = VK_TRUE,
                                                        .depthWriteEnable = info.under ? VK_FALSE : VK_TRUE,
                                                        .depthCompareOp = info.under ? vk::CompareOp::eEqual
                                                                                     : vk::CompareOp::eGreater};
    using Component = vk::ColorComponentFlagBits;
    const std::vector<vk::PipelineColorBlendAttachmentState> attachments(
        info.colorFormats.size(), {.blendEnable = info.under ? VK_TRUE : VK_FALSE,
                                   .srcColorBlendFactor = vk::BlendFactor::eOneMinusDstAlpha,
                                   .dstColorBlendFactor = vk::BlendFactor::eOne,
                                   .srcAlphaBlendFactor = vk::BlendFactor::eOneMinusDstAlpha,
                                   .dstAlphaBlendFactor = vk::BlendFactor::eOne,
                                   .colorWriteMask = Component::eR | Component::eG | Component::eB | Component::eA});
    const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = static_cast<std::uint32_t>(attachments.size()),
                                                      .pAttachments = attachments.data()};
    constexpr std::array dynamics{vk::DynamicState::eViewport, vk::DynamicState::eScissor, vk::DynamicState::eCullMode,
                                  vk::DynamicState::eFrontFace};
    const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount = dynamics.size(),
                                                     .pDynamicStates = dynamics.data()};
    const vk::PipelineRenderingCreateInfo rendering{.colorAttachmentCount =
                                                        static_cast<std::uint32_t>(info.colorFormats.size()),
                                                    .pColorAttachmentFormats = info.colorFormats.data(),
                                                    .depthAttachmentFormat = vk::Format::eD32Sfloat};
    vk::raii::Pipeline pipeline(gpu.device, gpu.pipelineCache,
                                vk::GraphicsPipelineCreateInfo{.pNext = &rendering,
                                                               .stageCount = stages.size(),
                                                               .pStages = stages.data(),
                                                               .pVertexInputState = &vertexInput,
                                                               .pInputAssemblyState = &assembly,
                                                               .pViewportState = &viewport,
                                                               .pRasterizationState = &rasterization,
                                                               .pMultisampleState = &multisample,
                                                               .pDepthStencilState = &depth,
                                                               .pColorBlendState = &blend,
                                                               .pDynamicState = &dynamic,
                                                               .layout = info.layout});
    gpu.name(pipeline, info.name);
    return pipeline;
}

} // namespace

ReloadablePipeline makeGraphicsPipeline(Gpu& gpu, const GraphicsPipelineInfo& info) {
    return {gpu, [&gpu, info] { return makePipeline(gpu, info); }};
}

vk::raii::PipelineLayout makeGraphicsLayout(const Gpu& gpu, std::span<const vk::DescriptorSetLayout> setLayouts,
                                            std::uint32_t pushBytes) {
    const vk::PushConstantRange push{
        .stageFlags = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, .size = pushBytes};
    return {gpu.device,
            {.setLayoutCount = static_cast<std::uint32_t>(setLayouts.size()),
             .pSetLayouts = setLayouts.data(),
             .pushConstantRangeCount = 1,
             .pPushConstantRanges = &push}};
}

void setWholeViewport(const vk::raii::CommandBuffer& commandBuffer, vk::Extent2D extent) {
    commandBuffer.setViewport(0, vk::Viewport{.width = static_cast<float>(extent.width),
                                              .height = static_cast<float>(extent.height),
                                              .maxDepth = 1});
    commandBuffer.setScissor(0, vk::Rect2D{.extent = extent});
}

} // namespace nacre::renderer
