#include "renderer/passes/blended_surfaces.hpp"

#include "renderer/vulkan/graphics_pipeline.hpp"

#include "blended_depth_frag.spv.h"
#include "blended_depth_vert.spv.h"
#include "blended_frag.spv.h"
#include "gbuffer_vert.spv.h"

namespace nacre::renderer {
namespace {

constexpr vk::Format colorFormat = vk::Format::eR16G16B16A16Sfloat;

vk::RenderingAttachmentInfo attachment(const Image& image, const Usage& use, bool first) {
    return {.imageView = image.view(),
            .imageLayout = use.layout,
            .loadOp = first ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad,
            .storeOp = vk::AttachmentStoreOp::eStore};
}

} // namespace

BlendedSurfaces::BlendedSurfaces(Gpu& gpu, const Inputs& inputs) {
    using Kind = vk::ImageUsageFlagBits;
    const bool used = inputs.scene.hasBlended();
    Image& depth = inputs.gbuffer.image(GBuffer::Depth);
    const vk::Extent2D extent = used ? depth.info().extent : vk::Extent2D{1, 1};
    blended_ = Image(gpu, {.name = "blended surfaces",
                           .format = colorFormat,
                           .extent = extent,
                           .usage = Kind::eColorAttachment | Kind::eSampled});
    for (Image& layer : depths_) {
        layer = Image(gpu, {.name = "depth of a blended layer",
                            .format = vk::Format::eD32Sfloat,
                            .extent = extent,
                            .usage = Kind::eDepthStencilAttachment | Kind::eSampled});
    }
    if (!used) {
        return;
    }
    using Stage = vk::ShaderStageFlagBits;
    constexpr vk::ShaderStageFlags stages = Stage::eVertex | Stage::eFragment;
    const FrameBuffer& view = inputs.gbuffer.view();
    const FrameBuffer& surfaces = inputs.scene.surfaces();
    for (std::size_t i = 0; i < depths_.size(); ++i) {
        const std::array bindings{uniform(view), storage(surfaces), sampled(depth, inputs.nearest),
                                  sampled(depths_[1 - i], inputs.nearest)};
        depthSets_[i] = DescriptorSets(gpu, bindings, stages);
    }
    Environment& environment = inputs.environment;
    const std::array bindings{uniform(view),
                              storage(surfaces),
                              uniform(environment.constants()),
                              storage(inputs.lighting.lights()),
                              sampled(inputs.shadowMaps.image(), inputs.nearest),
                              sampled(environment.specular(), environment.sampler()),
                              sampled(environment.reflectance(), environment.clampSampler())};
    lightSets_ = DescriptorSets(gpu, bindings, stages);
    for (Image* image : {&depth, &inputs.shadowMaps.image(), &environment.specular(), &environment.reflectance()}) {
        read_.push_back({*image, usage::fragmentRead});
    }
    const std::array depthLayouts{depthSets_[0].layout(), *inputs.scene.textureSetLayout()};
    const std::array lightLayouts{lightSets_.layout(), *inputs.scene.textureSetLayout()};
    depthLayout_ = makeGraphicsLayout(gpu, depthLayouts, sizeof(shared::DrawConstants));
    lightLayout_ = makeGraphicsLayout(gpu, lightLayouts, sizeof(shared::DrawConstants));
    const auto attributes = GpuScene::vertexAttributes();
    GraphicsPipelineInfo info{.name = "blended surfaces, depth",
                              .vertexShader = blended_depth_vert_spv,
                              .fragmentShader = blended_depth_frag_spv,
                              .vertexBindings = GpuScene::vertexBindings(),
                              .vertexAttributes = {attributes[0], attributes[1], attributes[4], attributes[5]},
                              .layout = *depthLayout_};
    depthPipeline_ = makeGraphicsPipeline(gpu, info);
    info.name = "blended surfaces, light";
    info.vertexShader = gbuffer_vert_spv;
    info.fragmentShader = blended_frag_spv;
    info.vertexAttributes = attributes;
    info.colorFormats = {colorFormat};
    info.under = true;
    info.layout = *lightLayout_;
    lightPipeline_ = makeGraphicsPipeline(gpu, info);
}

void BlendedSurfaces::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const GpuScene& scene,
                             std::uint32_t lightCount) {
    prepare(commandBuffer, read_);
    for (std::uint32_t layer = 0; layer < layerCount; ++layer) {
        recordDepth(commandBuffer, frame, scene, layer);
        recordLight(commandBuffer, frame, scene, layer, lightCount);
    }
}

void BlendedSurfaces::recordDepth(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                                  const GpuScene& scene, std::uint32_t layer) {
    const std::size_t own = layer % depths_.size();
    prepare(commandBuffer, {{depths_[own], usage::depthAttachment}, {depths_[1 - own], usage::fragmentRead}});
    const vk::RenderingAttachmentInfo depth = attachment(depths_[own], usage::depthAttachment, true);
    const vk::Extent2D extent = blended_.info().extent;
    commandBuffer.beginRendering({.renderArea = {.extent = extent}, .layerCount = 1, .pDepthAttachment = &depth});
    setWholeViewport(commandBuffer, extent);
    commandBuffer.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *depthLayout_, 0, depthSets_[own].of(frame), {});
    scene.recordDraws(commandBuffer, *depthLayout_, {.opaque = {}, .masked = {}, .blended = *depthPipeline_}, layer,
                      GpuScene::Cull::BackFaces);
    commandBuffer.endRendering();
}

void BlendedSurfaces::recordLight(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                                  const GpuScene& scene, std::uint32_t layer, std::uint32_t lightCount) {
    Image& layerDepth = depths_[layer % depths_.size()];
    prepare(commandBuffer, {{blended_, usage::colorAttachment}, {layerDepth, usage::depthAttachment}});
    const vk::RenderingAttachmentInfo color = attachment(blended_, usage::colorAttachment, layer == 0);
    const vk::RenderingAttachmentInfo depth = attachment(layerDepth, usage::depthAttachment, false);
    const vk::Extent2D extent = blended_.info().extent;
    commandBuffer.beginRendering({.renderArea = {.extent = extent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &color,
                                  .pDepthAttachment = &depth});
    setWholeViewport(commandBuffer, extent);
    commandBuffer.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *lightLayout_, 0, lightSets_.of(frame), {});
    scene.recordDraws(commandBuffer, *lightLayout_, {.opaque = {}, .masked = {}, .blended = *lightPipeline_},
                      lightCount, GpuScene::Cull::BackFaces);
    commandBuffer.endRendering();
}

} // namespace nacre::renderer
