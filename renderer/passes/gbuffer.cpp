#include "renderer/passes/gbuffer.hpp"

#include "renderer/vulkan/compute_pass.hpp"
#include "renderer/vulkan/graphics_pipeline.hpp"

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
     {"transmission", vk::Format::eR16Sfloat}}};

shared::ViewConstants makeConstants(const View& view, vk::Extent2D extent) {
    const glm::mat4& p = view.clipFromView;
    const glm::vec2 offset = view.perspective ? glm::vec2(p[2][0], p[2][1]) : -glm::vec2(p[3][0], p[3][1]);
    const glm::mat4 rows = glm::transpose(view.viewFromWorld);
    return {.clipFromWorld = p * view.viewFromWorld,
            .worldFromView = glm::inverse(view.viewFromWorld),
            .viewRow = -rows[2],
            .unproject = {1 / p[0][0], 1 / p[1][1], offset.x, offset.y},
            .size = {extent.width, extent.height, view.perspective ? 1u : 0u, 0u}};
}

} // namespace

GBuffer::GBuffer(Gpu& gpu, const GpuScene& scene, vk::Extent2D extent,
                 const std::array<vk::ImageUsageFlags, AttachmentCount>& effectUsage, std::uint32_t framesInFlight) {
    using Kind = vk::ImageUsageFlagBits;
    std::vector<vk::Format> formats;
    for (std::size_t i = 0; i < AttachmentCount; ++i) {
        const bool hasColors = i == Transmission && scene.hasTextures(&scene::Surface::transmissionColorTexture);
        formats.push_back(hasColors ? vk::Format::eR16G16B16A16Sfloat : attachmentInfos[i].format);
        images_[i] =
            Image(gpu, {.name = attachmentInfos[i].name,
                        .format = formats.back(),
                        .extent = extent,
                        .usage = Kind::eColorAttachment | Kind::eSampled | Kind::eTransferSrc | effectUsage[i]});
    }
    scaleView_ = images_[VertexNormal].makeChannelView(gpu, vk::ComponentSwizzle::eA);
    strengthView_ = images_[Emission].makeChannelView(gpu, vk::ComponentSwizzle::eA);
    shareView_ = images_[Albedo].makeChannelView(gpu, vk::ComponentSwizzle::eA);
    hardwareDepth_ = Image(gpu, {.name = "depth buffer",
                                 .format = vk::Format::eD32Sfloat,
                                 .extent = extent,
                                 .usage = Kind::eDepthStencilAttachment});
    view_ = FrameBuffer(gpu, "view constants", sizeof(shared::ViewConstants), vk::BufferUsageFlagBits::eUniformBuffer,
                        framesInFlight);

    using Stage = vk::ShaderStageFlagBits;
    const std::array bindings{uniform(view_), storage(scene.surfaces())};
    sets_ = DescriptorSets(gpu, bindings, Stage::eVertex | Stage::eFragment);
    const std::array setLayouts{sets_.layout(), *scene.textureSetLayout()};
    layout_ = makeGraphicsLayout(gpu, setLayouts, sizeof(shared::DrawConstants));
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

void GBuffer::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const GpuScene& scene,
                     const View& view) {
    const vk::Extent2D extent = hardwareDepth_.info().extent;
    view_.write(frame, bytesOf(makeConstants(view, extent)));
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
    commandBuffer.beginRendering({.renderArea = {.extent = extent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                                  .pColorAttachments = colors.data(),
                                  .pDepthAttachment = &depth});
    setWholeViewport(commandBuffer, extent);
    commandBuffer.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, sets_.of(frame), {});
    scene.recordDraws(commandBuffer, *layout_, {.opaque = *opaque_, .masked = *masked_, .blended = {}}, 0,
                      GpuScene::Cull::BackFaces);
    commandBuffer.endRendering();
}

} // namespace nacre::renderer
