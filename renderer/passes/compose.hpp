// Puts the picture together and turns it into 8-bit colour. Internal to the renderer.
#pragma once

#include "renderer/passes/environment.hpp"
#include "renderer/passes/gbuffer.hpp"
#include "renderer/passes/lighting.hpp"
#include "renderer/passes/subsurface.hpp"

namespace nacre::renderer {

class Compose {
public:
    struct Inputs {
        GBuffer& gbuffer;
        AmbientOcclusion& occlusion;
        Lighting& lighting;
        Subsurface& subsurface;
        Environment& environment;
        const vk::raii::Sampler& nearest;
    };

    struct Settings {
        bool scatter = true;
        bool scatteredHasAlbedo = false; ///< Subsurface::scatteredHasAlbedo
        bool transmit = true;
        float exposure = 1;
        std::uint32_t samples = 1; ///< per axis and pixel of the picture
        bool dither = false;
    };

    /// `extent` is the picture's; the inputs are `samples` times as large.
    Compose(Gpu& gpu, const Inputs& inputs, vk::Extent2D extent);

    /// Linear light before the tone curve. RGBA16F.
    Image& radiance() { return radiance_; }
    /// The picture, sRGB encoded. RGBA8.
    Image& color() { return color_; }
    void recordRadiance(const vk::raii::CommandBuffer& commandBuffer, const Settings& settings) const;
    void recordColor(const vk::raii::CommandBuffer& commandBuffer, const Settings& settings) const;

private:
    Image radiance_;
    Image color_;
    ComputePass radiancePass_;
    ComputePass colorPass_;
};

} // namespace nacre::renderer
