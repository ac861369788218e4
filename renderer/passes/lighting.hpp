// The light on every visible surface. Internal to the renderer.
#pragma once

#include "renderer/passes/ambient_occlusion.hpp"
#include "renderer/passes/environment.hpp"
#include "renderer/passes/gbuffer.hpp"
#include "renderer/passes/shadow_maps.hpp"

namespace nacre::renderer {

class Lighting {
public:
    struct Inputs {
        GBuffer& gbuffer;
        AmbientOcclusion& occlusion;
        ShadowMaps& shadowMaps;
        Environment& environment;
        const vk::raii::Sampler& nearest;
    };

    /// Room for `mostLights` lights and `maxMaterials` materials; `irradianceUsage` is what the effect wants of the
    /// irradiance image.
    Lighting(Gpu& gpu, const Inputs& inputs, std::size_t mostLights, std::size_t maxMaterials,
             vk::ImageUsageFlags irradianceUsage, std::uint32_t framesInFlight);

    /// Diffuse light without albedo and specular: diffuse radiance = albedo / π · irradiance. RGBA16F.
    Image& irradiance() { return irradiance_; }
    /// Specular radiance. RGBA16F.
    Image& specular() { return specular_; }
    void record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                std::span<const shared::LightConstants> lights, std::span<const shared::LobeConstants> lobes);
    /// What `record` was handed.
    const FrameBuffer& lights() const { return lights_; }
    /// Pixels with a subsurface material in the last frame of this number, which must have finished.
    std::uint32_t subsurfacePixels(std::uint32_t frame) const;
    template <typename Action> void forEachImage(const Action& action) {
        action(irradiance_);
        action(specular_);
    }

private:
    Image irradiance_;
    Image specular_;
    FrameBuffer lights_;
    FrameBuffer lobes_; ///< by material id
    FrameBuffer coverage_;
    ComputePass pass_;
};

} // namespace nacre::renderer
