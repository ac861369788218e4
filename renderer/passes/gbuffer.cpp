#include "renderer/passes/gbuffer.hpp"

#include "gbuffer_frag.spv.h"
#include "gbuffer_vert.spv.h"

namespace nacre::renderer {
namespace {

struct AttachmentInfo {
    const char* name;
    vk::Format format;
};

constexpr std::array<AttachmentInfo, GBuffer::AttachmentCount> attachmentInfos{
    {{"linear depth", vk::Format::eR32Sfloat},
     {"shading normal", vk::Format::eR16G16B16A16Sfloat},
     {"vertex normal", vk::Format::eR16G16B16A16Sfloat},
     {"albedo", vk::Format::eR16G16B16A16Sfloat},
     {"reflection", vk::Format::eR16G16B16A16Sfloat},
     {"emission", vk::Format::eR16G16B16A16Sfloat},
     {"material id", vk::Format::eR16Uint},
     {"authored thickness", vk::Format::eR16Sfloat}}};

} // namespace

GBuffer::GBuffer(Gpu& gpu, const GpuScene& scene, vk::Extent2D extent,
                 const std::array<vk::ImageUsageFlags, AttachmentCount>& effectUsage) {
    using Kind = vk::ImageUsageFlagBits;
    std::vector<vk::Format> formats;
    for (std::size_t i = 0; i < AttachmentCount; ++i) {
        images_[i] =
            Image(gpu, {.name = attachmentInfos[i].name,
                        .format = attachmentInfos[i].format,
                        .extent = extent,
                        .usage = Kind::eColorAttachment | Kind::eSampled | Kind::eTransferSrc | effectUsage[i]});
        formats.push_back(attachmentInfos[i].format);
    }
    hardwareDepth_ = Image(gpu, {.name = "depth buffer",
                                 .format = vk::Format::eD32Sfloat,
                                 .extent = extent,
                                 .usage = Kind::eDepthStencilAttachment});
    view_ =
        Buffer(gpu, "view constants", sizeof(shared::ViewConstants),
               vk::BufferUsageFlagBits::eUniformBuffer | vk::BufferUsageFlagBits::eTransferDst, Buffer::Place::Device);

    using Stage = vk::ShaderStageFlagBits;
    const std::array bindings{uniform(view_), storage(scene.surfaces())};
    const std::array types{bindings[0].type, bindings[1].type};
    setLayout_ = makeSetLayout(gpu, types, Stage::eVertex | Stage::eFragment);
    pool_ = makePool(gpu, types, 1);
    set_ = makeSet(gpu, pool_, setLayout_);
    writeSet(gpu, set_, bindings);
    const std::array setLayouts{*setLayout_, *scene.textureSetLayout()};
    const vk::PushConstantRange push{.stageFlags = Stage::eVertex | Stage::eFragment,
                                     .size = sizeof(shared::DrawConstants)};
    layout_ = vk::raii::PipelineLayout(gpu.device, {.setLayoutCount = setLayouts.size(),
                                                    .pSetLayouts = setLayouts.data(),
                                                    .pushConstantRangeCount = 1,
                                                    .pPushConstantRanges = &push});
    GraphicsPipelineInfo info{.name = "G-buffer, opaque",
                              .vertexShader = gbuffer_vert_spv,
                              .fragmentShader = gbuffer_frag_spv,
                              .vertexBindings = GpuScene::vertexBindings(),
                              .vertexAttributes = GpuScene::vertexAttributes(),
                              .colorFormats = formats,
                              .layout = *layout_};
    opaque_ = makeGraphicsPipeline(gpu, info);
    info.name = "G-buffer, masked";
    info.alphaMask = true;
    masked_ = makeGraphicsPipeline(gpu, info);
}

void GBuffer::setView(const vk::raii::CommandBuffer& commandBuffer, const View& view) const {
    const glm::mat4& p = view.clipFromView;
    const glm::vec2 offset = view.perspective ? glm::vec2(p[2][0], p[2][1]) : -glm::vec2(p[3][0], p[3][1]);
    const glm::mat4 rows = glm::transpose(view.viewFromWorld);
    const vk::Extent2D extent = images_[Depth].info().extent;
    const shared::ViewConstants constants{.clipFromWorld = p * view.viewFromWorld,
                                          .worldFromView = glm::inverse(view.viewFromWorld),
                                          .viewRow = -rows[2],
                                          .unproject = {1 / p[0][0], 1 / p[1][1], offset.x, offset.y},
                                          .size = {extent.width, extent.height, view.perspective ? 1u : 0u, 0u}};
    using Stage = vk::PipelineStageFlagBits2;
    const vk::PipelineStageFlags2 readers = Stage::eVertexShader | Stage::eFragmentShader | Stage::eComputeShader;
    const vk::MemoryBarrier2 before{.srcStageMask = readers,
                                    .srcAccessMask = vk::AccessFlagBits2::eUniformRead,
                                    .dstStageMask = Stage::eTransfer,
                                    .dstAccessMask = vk::AccessFlagBits2::eTransferWrite};
    const vk::MemoryBarrier2 after{.srcStageMask = Stage::eTransfer,
                                   .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                   .dstStageMask = readers,
                                   .dstAccessMask = vk::AccessFlagBits2::eUniformRead};
    commandBuffer.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &before});
    commandBuffer.updateBuffer<shared::ViewConstants>(view_.handle(), 0, constants);
    commandBuffer.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &after});
}

void GBuffer::record(const vk::raii::CommandBuffer& commandBuffer, const GpuScene& scene, const View& view) {
    setView(commandBuffer, view);
    std::vector<ImageUse> uses{{hardwareDepth_, usage::depthAttachment}};
    std::vector<vk::RenderingAttachmentInfo> colors;
    for (Image& image : images_) {
        uses.push_back({image, usage::colorAttachment});
        colors.push_back({.imageView = image.view(),
                          .imageLayout = usage::colorAttachment.layout,
                          .loadOp = vk::AttachmentLoadOp::eClear,
                          .storeOp = vk::AttachmentStoreOp::eStore});
    }
    colors[Depth].clearValue.color.float32[0] = view.farPlane;
    prepare(commandBuffer, uses);
    const vk::RenderingAttachmentInfo depth{.imageView = hardwareDepth_.view(),
                                            .imageLayout = usage::depthAttachment.layout,
                                            .loadOp = vk::AttachmentLoadOp::eClear,
                                            .storeOp = vk::AttachmentStoreOp::eDontCare,
                                            .clearValue = {.depthStencil = {.depth = 0}}};
    const vk::Extent2D extent = hardwareDepth_.info().extent;
    commandBuffer.beginRendering({.renderArea = {.extent = extent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                                  .pColorAttachments = colors.data(),
                                  .pDepthAttachment = &depth});
    setWholeViewport(commandBuffer, extent);
    commandBuffer.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *set_, {});
    scene.recordDraws(commandBuffer, *layout_, *opaque_, *masked_, 0, GpuScene::Cull::BackFaces);
    commandBuffer.endRendering();
}

} // namespace nacre::renderer
