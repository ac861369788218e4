#include "renderer/passes/lighting.hpp"

#include "lighting_comp.spv.h"

#include <algorithm>
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

} // namespace

Lighting::Lighting(Gpu& gpu, const Inputs& inputs, std::size_t mostLights, std::size_t maxMaterials,
                   vk::ImageUsageFlags irradianceUsage, std::uint32_t framesInFlight) {
    GBuffer& gbuffer = inputs.gbuffer;
    const vk::Extent2D extent = gbuffer.image(GBuffer::Depth).info().extent;
    irradiance_ = Image(gpu, lightImage("irradiance", extent, irradianceUsage));
    specular_ = Image(gpu, lightImage("specular", extent, {}));
    constexpr vk::BufferUsageFlags read = vk::BufferUsageFlagBits::eStorageBuffer;
    lights_ = FrameBuffer(gpu, "lights", std::max<std::size_t>(mostLights, 1) * sizeof(shared::LightConstants), read,
                          framesInFlight);
    lobes_ = FrameBuffer(gpu, "second lobes", (maxMaterials + 1) * sizeof(shared::LobeConstants), read, framesInFlight);
    coverage_ =
        FrameBuffer(gpu, "subsurface coverage", sizeof(std::uint32_t), read, framesInFlight, Buffer::Place::Host);
    const auto pixels = [&](GBuffer::Attachment attachment) {
        return sampled(gbuffer.image(attachment), inputs.nearest);
    };
    Environment& environment = inputs.environment;
    pass_ = ComputePass(gpu, "lighting", lighting_comp_spv,
                        {uniform(gbuffer.view()), uniform(environment.constants()), storage(lights_),
                         storage(coverage_), pixels(GBuffer::Depth), pixels(GBuffer::ShadingNormal),
                         pixels(GBuffer::VertexNormal), pixels(GBuffer::Reflection), pixels(GBuffer::MaterialId),
                         sampled(inputs.occlusion.visibility(), inputs.nearest),
                         sampled(inputs.shadowMaps.image(), inputs.nearest),
                         sampled(environment.specular(), environment.sampler()),
                         sampled(environment.reflectance(), environment.clampSampler()), written(irradiance_),
                         written(specular_), storage(lobes_)},
                        sizeof(std::uint32_t));
}

void Lighting::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                      std::span<const shared::LightConstants> lights, std::span<const shared::LobeConstants> lobes) {
    const std::uint32_t none = 0;
    coverage_.write(frame, bytesOf(none));
    lights_.write(frame, std::as_bytes(lights));
    lobes_.write(frame, std::as_bytes(lobes));
    const auto lightCount = static_cast<std::uint32_t>(lights.size());
    pass_.record(commandBuffer, frame, irradiance_.info().extent, bytesOf(lightCount));
    const vk::MemoryBarrier2 toHost{.srcStageMask = vk::PipelineStageFlagBits2::eComputeShader,
                                    .srcAccessMask = vk::AccessFlagBits2::eShaderWrite,
                                    .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                    .dstAccessMask = vk::AccessFlagBits2::eHostRead};
    commandBuffer.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &toHost});
}

std::uint32_t Lighting::subsurfacePixels(std::uint32_t frame) const {
    std::uint32_t pixels = 0;
    std::memcpy(&pixels, coverage_.mapped(frame), sizeof pixels);
    return pixels;
}

} // namespace nacre::renderer
