#include "renderer/picture_passes.hpp"

#include "renderer/vulkan/memory_meter.hpp"

#include <string>

namespace nacre::renderer {
namespace {

/// Largest supersampling per axis.
constexpr std::uint32_t maxSamples = 4;

std::array<vk::ImageUsageFlags, GBuffer::AttachmentCount> gbufferUsage() {
    std::array<vk::ImageUsageFlags, GBuffer::AttachmentCount> result{};
    result[GBuffer::Depth] = effectUsage(NACRE_IMAGE_DEPTH);
    result[GBuffer::VertexNormal] = effectUsage(NACRE_IMAGE_NORMAL) | effectUsage(NACRE_IMAGE_SCALE);
    result[GBuffer::Albedo] = effectUsage(NACRE_IMAGE_ALBEDO) | effectUsage(NACRE_IMAGE_STRENGTH);
    result[GBuffer::Emission] = effectUsage(NACRE_IMAGE_STRENGTH);
    result[GBuffer::MaterialId] = effectUsage(NACRE_IMAGE_MATERIAL_ID);
    result[GBuffer::Transmission] = effectUsage(NACRE_IMAGE_THICKNESS);
    return result;
}

} // namespace

vk::Extent2D checkedExtent(const Gpu& gpu, const RenderSettings& settings) {
    const std::string size = std::to_string(settings.width) + "x" + std::to_string(settings.height);
    if (settings.width == 0 || settings.height == 0) {
        throw RendererError("a picture of " + size + " pixels has nothing in it; both sides must be at least 1");
    }
    if (settings.samples == 0 || settings.samples > maxSamples) {
        throw RendererError("samples is " + std::to_string(settings.samples) + ", and must lie between 1 and " +
                            std::to_string(maxSamples));
    }
    const std::uint32_t largest = gpu.limits.maxImageDimension2D;
    if (settings.width > largest / settings.samples || settings.height > largest / settings.samples) {
        throw RendererError("a picture of " + size + " pixels with " + std::to_string(settings.samples) +
                            " samples per axis is larger than the Vulkan device's limit of " + std::to_string(largest) +
                            "x" + std::to_string(largest));
    }
    return {settings.width * settings.samples, settings.height * settings.samples};
}

PicturePasses::PicturePasses(Gpu& gpu, const Inputs& inputs, const RenderSettings& settings, const Limits& limits)
    : extent(checkedExtent(gpu, settings)),
      gbuffer(metered(gpu, memory, "G-buffer",
                      [&] { return GBuffer(gpu, inputs.scene, extent, gbufferUsage(), limits.framesInFlight); })),
      occlusion(
          metered(gpu, memory, "ambient occlusion", [&] { return AmbientOcclusion(gpu, gbuffer, inputs.nearest); })),
      lighting(metered(gpu, memory, "lighting",
                       [&] {
                           return Lighting(gpu,
                                           {gbuffer, occlusion, inputs.shadowMaps, inputs.environment, inputs.nearest},
                                           limits.lights, limits.materials, effectUsage(NACRE_IMAGE_IRRADIANCE),
                                           limits.framesInFlight);
                       })),
      subsurface(
          metered(gpu, memory, "effect: outputs", [&] { return SubsurfaceImages(gpu, extent, settings.thickness); })),
      blended(metered(gpu, memory, "blended surfaces",
                      [&] {
                          return BlendedSurfaces(gpu, {inputs.scene, gbuffer, lighting, inputs.shadowMaps,
                                                       inputs.environment, inputs.nearest});
                      })),
      compose(metered(gpu, memory, "compose and tone map", [&] {
          return Compose(gpu, {gbuffer, occlusion, lighting, subsurface, blended, inputs.environment, inputs.nearest},
                         {settings.width, settings.height}, limits.materials, limits.framesInFlight);
      })) {
    if (settings.copyFloor) {
        copyFloor.emplace(
            gpu,
            CopyFloor::Inputs{lighting.irradiance(), gbuffer.image(GBuffer::Depth), gbuffer.image(GBuffer::MaterialId)},
            inputs.nearest);
    }
}

} // namespace nacre::renderer
