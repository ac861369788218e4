#include "renderer/passes/compose_picture.hpp"

#include "compose_picture_comp.spv.h"
#include "tone_map_comp.spv.h"

namespace nacre::renderer {
namespace {

struct RadiancePush {
    std::uint32_t scatter;
    std::uint32_t scatteredHasAlbedo;
    std::uint32_t transmit;
    std::uint32_t hasThickness;
    std::uint32_t hasScale;
    std::uint32_t hasTransmissionColors;
    std::uint32_t hasBlended;
};

struct ColorPush {
    float exposure;
    std::uint32_t samples;
    std::uint32_t dither;
};

} // namespace

Compose::Compose(Gpu& gpu, const Inputs& inputs, vk::Extent2D extent, std::size_t materialCount,
                 std::uint32_t framesInFlight) {
    using Kind = vk::ImageUsageFlagBits;
    GBuffer& gbuffer = inputs.gbuffer;
    radiance_ = Image(gpu, {.name = "radiance",
                            .format = vk::Format::eR16G16B16A16Sfloat,
                            .extent = gbuffer.image(GBuffer::Depth).info().extent,
                            .usage = Kind::eStorage | Kind::eSampled | Kind::eTransferSrc});
    color_ = Image(gpu, {.name = "color",
                         .format = vk::Format::eR8G8B8A8Unorm,
                         .extent = extent,
                         .usage = Kind::eStorage | Kind::eTransferSrc});
    transmissions_ = FrameBuffer(gpu, "transmissions", (materialCount + 1) * sizeof(shared::TransmissionConstants),
                                 vk::BufferUsageFlagBits::eStorageBuffer, framesInFlight);
    const auto pixels = [&](Image& image) { return sampled(image, inputs.nearest); };
    Environment& environment = inputs.environment;
    radiancePass_ = ComputePass(
        gpu, "compose", compose_picture_comp_spv,
        {uniform(gbuffer.view()), uniform(environment.constants()), storage(transmissions_),
         pixels(gbuffer.image(GBuffer::ShadingNormal)), pixels(gbuffer.image(GBuffer::Albedo)),
         pixels(gbuffer.image(GBuffer::Emission)), pixels(gbuffer.image(GBuffer::MaterialId)),
         pixels(inputs.lighting.irradiance()), pixels(inputs.lighting.specular()), pixels(inputs.subsurface.scattered),
         pixels(inputs.subsurface.transmitted), sampled(environment.radiance(), environment.sampler()),
         pixels(inputs.occlusion.visibility()), pixels(gbuffer.image(GBuffer::Transmission)),
         pixels(inputs.blended.image()), pixels(gbuffer.image(GBuffer::VertexNormal)), written(radiance_)},
        sizeof(RadiancePush));
    colorPass_ =
        ComputePass(gpu, "tone map", tone_map_comp_spv, {pixels(radiance_), written(color_)}, sizeof(ColorPush));
}

void Compose::recordRadiance(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                             const Settings& settings) {
    transmissions_.write(frame, std::as_bytes(settings.transmissions));
    const auto flag = [](bool is) { return is ? 1u : 0u; };
    const RadiancePush push{.scatter = flag(settings.scatter),
                            .scatteredHasAlbedo = flag(settings.scatteredHasAlbedo),
                            .transmit = flag(settings.transmit),
                            .hasThickness = flag(settings.hasThickness),
                            .hasScale = flag(settings.hasScale),
                            .hasTransmissionColors = flag(settings.hasTransmissionColors),
                            .hasBlended = flag(settings.hasBlended)};
    radiancePass_.record(commandBuffer, frame, radiance_.info().extent, bytesOf(push));
}

void Compose::recordColor(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                          const Settings& settings) const {
    const ColorPush push{settings.exposure, settings.samples, settings.dither ? 1u : 0u};
    colorPass_.record(commandBuffer, frame, color_.info().extent, bytesOf(push));
}

} // namespace nacre::renderer
