// Puts the picture together and turns it into 8-bit colour. Internal to the renderer.
#pragma once

#include "renderer/passes/blended_surfaces.hpp"
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
        SubsurfaceImages& subsurface;
        BlendedSurfaces& blended;
        Environment& environment;
        const vk::raii::Sampler& nearest;
    };

    struct Settings {
        std::span<const shared::TransmissionConstants>
            transmissions; ///< by material id, of those the inputs have room for
        bool scatter = true;
        bool scatteredHasAlbedo = false; ///< Subsurface::scatteredHasAlbedo
        bool transmit = true;
        bool hasThickness =
            false; ///< whether a subsurface body has an authored thickness, through which surroundings shine
        bool hasScale = false;              ///< whether surfaces multiply the lengths of their materials
        bool hasTransmissionColors = false; ///< whether textures have the colour of what comes through
        bool hasBlended = false;            ///< whether BlendedSurfaces was recorded
        float exposure = 1;
        std::uint32_t samples = 1; ///< per axis and pixel of the picture
        bool dither = false;
    };

    /// `extent` is the picture's; the inputs are `samples` times as large. Ids of materials go to `materialCount`.
    Compose(Gpu& gpu, const Inputs& inputs, vk::Extent2D extent, std::size_t materialCount,
            std::uint32_t framesInFlight);

    /// Linear light before the tone curve. RGBA16F.
    Image& radiance() { return radiance_; }
    /// The picture, sRGB encoded. RGBA8.
    Image& color() { return color_; }
    void recordRadiance(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const Settings& settings);
    void recordColor(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const Settings& settings) const;
    template <typename Action> void forEachImage(const Action& action) {
        action(radiance_);
        action(color_);
    }

private:
    Image radiance_;
    Image color_;
    FrameBuffer transmissions_;
    ComputePass radiancePass_;
    ComputePass colorPass_;
};

} // namespace nacre::renderer
