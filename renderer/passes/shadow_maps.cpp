#include "renderer/passes/shadow_maps.hpp"

#include "renderer/vulkan/graphics_pipeline.hpp"

#include "shadow_frag.spv.h"
#include "shadow_masked_frag.spv.h"
#include "shadow_masked_vert.spv.h"
#include "shadow_vert.spv.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace nacre::renderer {
namespace {

constexpr vk::Format linearFormat = vk::Format::eR32Sfloat;

ImageInfo mapInfo(std::uint32_t size, std::uint32_t layers) {
    using Kind = vk::ImageUsageFlagBits;
    return {.name = "shadow maps",
            .format = linearFormat,
            .extent = {size, size},
            .usage = Kind::eColorAttachment | Kind::eSampled,
            .layers = layers,
            .viewType = vk::ImageViewType::e2DArray};
}

ImageInfo hardwareDepthInfo(std::uint32_t size) {
    return {.name = "shadow maps' depth test",
            .format = vk::Format::eD32Sfloat,
            .extent = {size, size},
            .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment};
}

} // namespace

ShadowMaps::ShadowMaps(Gpu& gpu, const GpuScene& scene, std::uint32_t layerCount, std::uint32_t size,
                       std::uint32_t framesInFlight)
    : drawn_(layerCount) {
    if (size == 0) {
        throw RendererError("the shadow maps' size must be at least 1 pixel, not 0");
    }
    // Without shadow maps the passes that read them still need something to bind.
    const std::uint32_t side = layerCount == 0 ? 1 : size;
    depth_ = Image(gpu, mapInfo(side, std::max(layerCount, 1u)));
    hardwareDepth_ = Image(gpu, hardwareDepthInfo(side));
    for (std::uint32_t layer = 0; layer < layerCount; ++layer) {
        layerViews_.push_back(depth_.makeView(gpu, vk::ImageViewType::e2D, 0, layer, 1));
    }
    layers_ = FrameBuffer(gpu, "shadow layers", std::max(layerCount, 1u) * sizeof(shared::ShadowLayer),
                          vk::BufferUsageFlagBits::eStorageBuffer, framesInFlight);

    using Stage = vk::ShaderStageFlagBits;
    const std::array bindings{storage(layers_), storage(scene.surfaces())};
    sets_ = DescriptorSets(gpu, bindings, Stage::eVertex | Stage::eFragment);
    const std::array setLayouts{sets_.layout(), *scene.textureSetLayout()};
    layout_ = makeGraphicsLayout(gpu, setLayouts, sizeof(shared::DrawConstants));
    const auto vertexBindings = GpuScene::vertexBindings();
    const auto vertexAttributes = GpuScene::vertexAttributes();
    opaque_ = makeGraphicsPipeline(gpu, {.name = "shadow map, opaque",
                                         .vertexShader = shadow_vert_spv,
                                         .fragmentShader = shadow_frag_spv,
                                         .vertexBindings = {vertexBindings[0]},
                                         .vertexAttributes = {vertexAttributes[0]},
                                         .colorFormats = {linearFormat},
                                         .layout = *layout_});
    masked_ = makeGraphicsPipeline(
        gpu, {.name = "shadow map, masked",
              .vertexShader = shadow_masked_vert_spv,
              .fragmentShader = shadow_masked_frag_spv,
              .vertexBindings = vertexBindings,
              .vertexAttributes = {vertexAttributes[0], vertexAttributes[1], vertexAttributes[4], vertexAttributes[5]},
              .colorFormats = {linearFormat},
              .layout = *layout_});
}

std::vector<std::uint32_t> ShadowMaps::staleLayers(const GpuScene& scene, std::span<const shared::ShadowLayer> layers) {
    if (drawnCasters_ != scene.casterVersion()) {
        invalidate();
        drawnCasters_ = scene.casterVersion();
    }
    std::vector<std::uint32_t> stale;
    for (std::uint32_t layer = 0; layer < layers.size(); ++layer) {
        if (!drawn_[layer] || std::memcmp(&*drawn_[layer], &layers[layer], sizeof(shared::ShadowLayer)) != 0) {
            drawn_[layer] = layers[layer];
            stale.push_back(layer);
        }
    }
    return stale;
}

std::uint32_t ShadowMaps::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                                 const GpuScene& scene, std::span<const shared::ShadowLayer> layers) {
    const std::vector<std::uint32_t> stale = staleLayers(scene, layers);
    if (!stale.empty()) {
        layers_.write(frame, std::as_bytes(layers));
        prepare(commandBuffer, {{depth_, usage::colorAttachment}});
    }
    for (const std::uint32_t layer : stale) {
        recordLayer(commandBuffer, frame, scene, layer);
    }
    return static_cast<std::uint32_t>(stale.size());
}

void ShadowMaps::recordLayer(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const GpuScene& scene,
                             std::uint32_t layer) {
    const vk::Rect2D area{.extent = depth_.info().extent};
    prepare(commandBuffer, {{hardwareDepth_, usage::depthAttachment}});
    const vk::RenderingAttachmentInfo color{.imageView = *layerViews_[layer],
                                            .imageLayout = usage::colorAttachment.layout,
                                            .loadOp = vk::AttachmentLoadOp::eClear,
                                            .storeOp = vk::AttachmentStoreOp::eStore,
                                            .clearValue = {.color = {.float32 = std::array{1.0f, 1.0f, 1.0f, 1.0f}}}};
    const vk::RenderingAttachmentInfo depth{.imageView = hardwareDepth_.view(),
                                            .imageLayout = usage::depthAttachment.layout,
                                            .loadOp = vk::AttachmentLoadOp::eClear,
                                            .storeOp = vk::AttachmentStoreOp::eDontCare,
                                            .clearValue = {.depthStencil = {.depth = 0}}};
    commandBuffer.beginRendering({.renderArea = area,
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &color,
                                  .pDepthAttachment = &depth});
    setWholeViewport(commandBuffer, area.extent);
    commandBuffer.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, sets_.of(frame), {});
    // Blended surfaces are masked at scene::blendedShadowCutoff: a map has one depth a texel.
    // Both sides: an open or inside-out mesh throws a shadow too, and the nearest surface is what counts.
    scene.recordDraws(commandBuffer, *layout_, {*opaque_, *masked_, *masked_}, layer, GpuScene::Cull::Nothing);
    commandBuffer.endRendering();
}

} // namespace nacre::renderer
