#include "renderer/passes/lighting.hpp"

#include "ambient_occlusion_comp.spv.h"
#include "ambient_occlusion_filter_comp.spv.h"
#include "lighting_comp.spv.h"

#include <cstring>

namespace nacre::renderer {
namespace {

ImageInfo lightImage(const char* name, vk::Extent2D extent, vk::ImageUsageFlags extra) {
    using Kind = vk::ImageUsageFlagBits;
    return {.name = name,
            .format = vk::Format::eR16G16B16A16Sfloat,
            .extent = extent,
            .usage = Kind::eStorage | Kind::eSampled | Kind::eTransferSrc | extra};
}

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

void AmbientOcclusion::record(const vk::raii::CommandBuffer& commandBuffer, float radius) const {
    search_.record(commandBuffer, pattern_.info().extent, bytesOf(radius));
    filter_.record(commandBuffer, visibility_.info().extent);
}

Lighting::Lighting(Gpu& gpu, const Inputs& inputs, const std::vector<shared::LightConstants>& lights,
                   vk::ImageUsageFlags irradianceUsage)
    : lightCount_(static_cast<std::uint32_t>(lights.size())) {
    GBuffer& gbuffer = inputs.gbuffer;
    const vk::Extent2D extent = gbuffer.image(GBuffer::Depth).info().extent;
    irradiance_ = Image(gpu, lightImage("irradiance", extent, irradianceUsage));
    specular_ = Image(gpu, lightImage("specular", extent, {}));
    lights_ = uploadBuffer(gpu, "lights", std::as_bytes(std::span(lights)), vk::BufferUsageFlagBits::eStorageBuffer);
    coverage_ = Buffer(gpu, "subsurface coverage", sizeof(std::uint32_t), vk::BufferUsageFlagBits::eStorageBuffer,
                       Buffer::Place::Host);
    const auto pixels = [&](GBuffer::Attachment attachment) {
        return sampled(gbuffer.image(attachment), inputs.nearest);
    };
    Environment& environment = inputs.environment;
    pass_ = ComputePass(
        gpu, "lighting", lighting_comp_spv,
        {uniform(gbuffer.view()), uniform(environment.constants()), storage(lights_), storage(coverage_),
         pixels(GBuffer::Depth), pixels(GBuffer::ShadingNormal), pixels(GBuffer::VertexNormal),
         pixels(GBuffer::Reflection), pixels(GBuffer::MaterialId),
         sampled(inputs.occlusion.visibility(), inputs.nearest), sampled(inputs.shadowMaps.image(), inputs.nearest),
         sampled(environment.specular(), environment.sampler()),
         sampled(environment.reflectance(), environment.clampSampler()), written(irradiance_), written(specular_)},
        sizeof lightCount_);
}

void Lighting::record(const vk::raii::CommandBuffer& commandBuffer) {
    std::memset(coverage_.mapped(), 0, sizeof(std::uint32_t));
    pass_.record(commandBuffer, irradiance_.info().extent, bytesOf(lightCount_));
    const vk::MemoryBarrier2 toHost{.srcStageMask = vk::PipelineStageFlagBits2::eComputeShader,
                                    .srcAccessMask = vk::AccessFlagBits2::eShaderWrite,
                                    .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                    .dstAccessMask = vk::AccessFlagBits2::eHostRead};
    commandBuffer.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &toHost});
}

std::uint32_t Lighting::subsurfacePixels() const {
    std::uint32_t pixels = 0;
    std::memcpy(&pixels, coverage_.mapped(), sizeof pixels);
    return pixels;
}

} // namespace nacre::renderer
