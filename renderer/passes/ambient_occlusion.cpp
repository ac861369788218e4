#include "renderer/passes/ambient_occlusion.hpp"

#include "ambient_occlusion_comp.spv.h"
#include "ambient_occlusion_filter_comp.spv.h"

namespace nacre::renderer {
namespace {

ImageInfo visibilityImage(const char* name, vk::Extent2D extent) {
    return {.name = name,
            .format = vk::Format::eR32Sfloat,
            .extent = extent,
            .usage = vk::ImageUsageFlagBits::eStorage | vk::ImageUsageFlagBits::eSampled};
}

} // namespace

AmbientOcclusion::AmbientOcclusion(Gpu& gpu, GBuffer& gbuffer, const vk::raii::Sampler& nearest) {
    Image& depth = gbuffer.image(GBuffer::Depth);
    pattern_ = Image(gpu, visibilityImage("ambient occlusion pattern", depth.info().extent));
    visibility_ = Image(gpu, visibilityImage("ambient occlusion", depth.info().extent));
    search_ = ComputePass(gpu, "ambient occlusion", ambient_occlusion_comp_spv,
                          {uniform(gbuffer.view()), sampled(depth, nearest),
                           sampled(gbuffer.image(GBuffer::VertexNormal), nearest), written(pattern_)},
                          sizeof(float));
    filter_ = ComputePass(gpu, "ambient occlusion filter", ambient_occlusion_filter_comp_spv,
                          {sampled(pattern_, nearest), sampled(depth, nearest), written(visibility_)});
}

void AmbientOcclusion::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, float radius) const {
    search_.record(commandBuffer, frame, pattern_.info().extent, bytesOf(radius));
    filter_.record(commandBuffer, frame, visibility_.info().extent);
}

} // namespace nacre::renderer
