#include "renderer/vulkan/compute_pass.hpp"

#include "renderer/passes/shader_types.h"

namespace nacre::renderer {

ComputePass::ComputePass(Gpu& gpu, const std::string& name, const EmbeddedShader& shader,
                         const std::vector<Binding>& bindings, std::uint32_t pushBytes)
    : uses_(imageUses(bindings)), sets_(gpu, bindings, vk::ShaderStageFlagBits::eCompute) {
    const vk::PushConstantRange push{.stageFlags = vk::ShaderStageFlagBits::eCompute, .size = pushBytes};
    const vk::DescriptorSetLayout setLayout = sets_.layout();
    layout_ = vk::raii::PipelineLayout(gpu.device, {.setLayoutCount = 1,
                                                    .pSetLayouts = &setLayout,
                                                    .pushConstantRangeCount = pushBytes ? 1u : 0u,
                                                    .pPushConstantRanges = &push});
    pipeline_ = ReloadablePipeline(gpu, [&gpu, name, shader, layout = *layout_] {
        const vk::raii::ShaderModule module = makeShaderModule(gpu, shader);
        vk::raii::Pipeline pipeline(
            gpu.device, gpu.pipelineCache,
            vk::ComputePipelineCreateInfo{
                .stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *module, .pName = "main"},
                .layout = layout});
        gpu.name(pipeline, name);
        return pipeline;
    });
}

void ComputePass::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, vk::Extent2D extent,
                         std::span<const std::byte> push, std::uint32_t layers) const {
    prepare(commandBuffer, uses_);
    commandBuffer.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    commandBuffer.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, sets_.of(frame), {});
    if (!push.empty()) {
        commandBuffer.pushConstants<std::byte>(
            *layout_, vk::ShaderStageFlagBits::eCompute, 0,
            vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    }
    const auto groups = [](std::uint32_t pixels) { return (pixels + shared::groupSize - 1) / shared::groupSize; };
    commandBuffer.dispatch(groups(extent.width), groups(extent.height), layers);
}

} // namespace nacre::renderer
