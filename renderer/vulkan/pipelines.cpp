#include "renderer/vulkan/pipelines.hpp"

#include "renderer/passes/shader_types.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace nacre::renderer {
namespace {

vk::raii::ShaderModule makeShader(const Gpu& gpu, std::span<const std::uint32_t> spirv) {
    return {gpu.device, {.codeSize = spirv.size_bytes(), .pCode = spirv.data()}};
}

bool isImage(vk::DescriptorType type) {
    return type == vk::DescriptorType::eCombinedImageSampler || type == vk::DescriptorType::eStorageImage;
}

const Usage& usageOf(const Binding& binding) {
    return binding.type == vk::DescriptorType::eStorageImage ? usage::computeWrite : usage::computeRead;
}

std::vector<vk::DescriptorType> typesOf(std::span<const Binding> bindings) {
    std::vector<vk::DescriptorType> types;
    std::transform(bindings.begin(), bindings.end(), std::back_inserter(types),
                   [](const Binding& binding) { return binding.type; });
    return types;
}

} // namespace

Binding sampled(Image& image, const vk::raii::Sampler& sampler) {
    return {.type = vk::DescriptorType::eCombinedImageSampler, .image = &image, .sampler = *sampler};
}

Binding written(Image& image, vk::ImageView view) {
    return {.type = vk::DescriptorType::eStorageImage, .image = &image, .view = view};
}

Binding uniform(const Buffer& buffer) {
    return {.type = vk::DescriptorType::eUniformBuffer, .buffer = buffer.handle()};
}

Binding storage(const Buffer& buffer) {
    return {.type = vk::DescriptorType::eStorageBuffer, .buffer = buffer.handle()};
}

vk::raii::DescriptorSetLayout makeSetLayout(const Gpu& gpu, std::span<const vk::DescriptorType> types,
                                            vk::ShaderStageFlags stages) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const vk::DescriptorType type : types) {
        bindings.push_back({.binding = static_cast<std::uint32_t>(bindings.size()),
                            .descriptorType = type,
                            .descriptorCount = 1,
                            .stageFlags = stages});
    }
    return {gpu.device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()}};
}

vk::raii::DescriptorPool makePool(const Gpu& gpu, std::span<const vk::DescriptorType> types, std::uint32_t sets) {
    std::vector<vk::DescriptorPoolSize> sizes;
    for (const vk::DescriptorType type : types) {
        sizes.push_back({.type = type, .descriptorCount = sets});
    }
    return {gpu.device,
            {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
             .maxSets = sets,
             .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
             .pPoolSizes = sizes.data()}};
}

vk::raii::DescriptorSet makeSet(const Gpu& gpu, const vk::raii::DescriptorPool& pool,
                                const vk::raii::DescriptorSetLayout& layout) {
    vk::raii::DescriptorSets sets(gpu.device,
                                  {.descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &*layout});
    return std::move(sets.front());
}

void writeSet(const Gpu& gpu, const vk::raii::DescriptorSet& set, std::span<const Binding> bindings) {
    std::vector<vk::DescriptorImageInfo> images(bindings.size());
    std::vector<vk::DescriptorBufferInfo> buffers(bindings.size());
    std::vector<vk::WriteDescriptorSet> writes;
    for (std::size_t i = 0; i < bindings.size(); ++i) {
        const Binding& binding = bindings[i];
        if (isImage(binding.type)) {
            images[i] = vk::DescriptorImageInfo{.sampler = binding.sampler,
                                                .imageView = binding.view ? binding.view : binding.image->view(),
                                                .imageLayout = usageOf(binding).layout};
        } else {
            buffers[i] = vk::DescriptorBufferInfo{.buffer = binding.buffer, .range = VK_WHOLE_SIZE};
        }
        writes.push_back({.dstSet = *set,
                          .dstBinding = static_cast<std::uint32_t>(i),
                          .descriptorCount = 1,
                          .descriptorType = binding.type,
                          .pImageInfo = &images[i],
                          .pBufferInfo = &buffers[i]});
    }
    gpu.device.updateDescriptorSets(writes, {});
}

ComputePass::ComputePass(Gpu& gpu, const std::string& name, std::span<const std::uint32_t> spirv,
                         const std::vector<Binding>& bindings, std::uint32_t pushBytes)
    : name_(name), bindings_(bindings) {
    const std::vector<vk::DescriptorType> types = typesOf(bindings);
    setLayout_ = makeSetLayout(gpu, types, vk::ShaderStageFlagBits::eCompute);
    const vk::PushConstantRange push{.stageFlags = vk::ShaderStageFlagBits::eCompute, .size = pushBytes};
    layout_ = vk::raii::PipelineLayout(gpu.device, {.setLayoutCount = 1,
                                                    .pSetLayouts = &*setLayout_,
                                                    .pushConstantRangeCount = pushBytes ? 1u : 0u,
                                                    .pPushConstantRanges = &push});
    const vk::raii::ShaderModule shader = makeShader(gpu, spirv);
    pipeline_ = vk::raii::Pipeline(
        gpu.device, nullptr,
        vk::ComputePipelineCreateInfo{
            .stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *shader, .pName = "main"},
            .layout = *layout_});
    gpu.name(pipeline_, name);
    pool_ = makePool(gpu, types, 1);
    set_ = makeSet(gpu, pool_, setLayout_);
    writeSet(gpu, set_, bindings);
}

void ComputePass::record(const vk::raii::CommandBuffer& commandBuffer, vk::Extent2D extent,
                         std::span<const std::byte> push, std::uint32_t layers) const {
    std::vector<ImageUse> uses;
    for (const Binding& binding : bindings_) {
        if (isImage(binding.type)) {
            uses.push_back({*binding.image, usageOf(binding)});
        }
    }
    prepare(commandBuffer, uses);
    commandBuffer.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    commandBuffer.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, *set_, {});
    if (!push.empty()) {
        commandBuffer.pushConstants<std::byte>(
            *layout_, vk::ShaderStageFlagBits::eCompute, 0,
            vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    }
    const auto groups = [](std::uint32_t pixels) { return (pixels + shared::groupSize - 1) / shared::groupSize; };
    commandBuffer.dispatch(groups(extent.width), groups(extent.height), layers);
}

vk::raii::Pipeline makeGraphicsPipeline(const Gpu& gpu, const GraphicsPipelineInfo& info) {
    const vk::raii::ShaderModule vertexShader = makeShader(gpu, info.vertexShader);
    const vk::raii::ShaderModule fragmentShader = makeShader(gpu, info.fragmentShader);
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
    const vk::PipelineDepthStencilStateCreateInfo depth{
        .depthTestEnable = VK_TRUE, .depthWriteEnable = VK_TRUE, .depthCompareOp = vk::CompareOp::eGreater};
    using Component = vk::ColorComponentFlagBits;
    const std::vector<vk::PipelineColorBlendAttachmentState> attachments(
        info.colorFormats.size(), {.colorWriteMask = Component::eR | Component::eG | Component::eB | Component::eA});
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
    vk::raii::Pipeline pipeline(gpu.device, nullptr,
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

void setWholeViewport(const vk::raii::CommandBuffer& commandBuffer, vk::Extent2D extent) {
    commandBuffer.setViewport(0, vk::Viewport{.width = static_cast<float>(extent.width),
                                              .height = static_cast<float>(extent.height),
                                              .maxDepth = 1});
    commandBuffer.setScissor(0, vk::Rect2D{.extent = extent});
}

Label::Label(const Gpu& gpu, const vk::raii::CommandBuffer& commandBuffer, const std::string& text)
    : commandBuffer_(gpu.labels ? &commandBuffer : nullptr) {
    if (commandBuffer_) {
        commandBuffer_->beginDebugUtilsLabelEXT({.pLabelName = text.c_str()});
    }
}

Label::~Label() {
    if (commandBuffer_) {
        commandBuffer_->endDebugUtilsLabelEXT();
    }
}

} // namespace nacre::renderer
