// Ambient occlusion, and the light on every visible surface. Internal to the renderer.
#pragma once

#include "renderer/passes/environment.hpp"
#include "renderer/passes/gbuffer.hpp"
#include "renderer/light_placement.hpp"
#include "renderer/passes/shadow_maps.hpp"

namespace nacre::renderer {

/// Share of the surroundings that reaches each visible surface past what the depth image shows.
class AmbientOcclusion {
public:
    AmbientOcclusion(Gpu& gpu, GBuffer& gbuffer, const vk::raii::Sampler& nearest);

    /// R32F, 1 where nothing is in the way.
    Image& visibility() { return visibility_; }
    /// `radius` [scene units]: how far things occlude.
    void record(const vk::raii::CommandBuffer& commandBuffer, float radius) const;

private:
    Image pattern_;
    Image visibility_;
    ComputePass search_;
    ComputePass filter_;
};

class Lighting {
public:
    struct Inputs {
        GBuffer& gbuffer;
        AmbientOcclusion& occlusion;
        ShadowMaps& shadowMaps;
        Environment& environment;
        const vk::raii::Sampler& nearest;
    };

    /// `irradianceUsage` is what the effect wants of the irradiance image.
    Lighting(Gpu& gpu, const Inputs& inputs, const std::vector<shared::LightConstants>& lights,
             vk::ImageUsageFlags irradianceUsage);

    /// Diffuse light without albedo and specular: diffuse radiance = albedo / π · irradiance. RGBA16F.
    Image& irradiance() { return irradiance_; }
    /// Specular radiance. RGBA16F.
    Image& specular() { return specular_; }
    void record(const vk::raii::CommandBuffer& commandBuffer);
    /// Pixels with a subsurface material in the last frame that has finished.
    std::uint32_t subsurfacePixels() const;

private:
    Image irradiance_;
    Image specular_;
    Buffer lights_;
    Buffer coverage_;
    std::uint32_t lightCount_ = 0;
    ComputePass pass_;
};

} // namespace nacre::renderer
