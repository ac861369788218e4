// Surfaces that let through what is behind them: corneas, glasses, lashes. They are no part of the G-buffer. So what is
// behind them is lit and scatters as if they were not there, and compose mixes them into the picture.
//
// They are drawn in layers, nearest first (depth peeling: Everitt 2001, "Interactive order-independent transparency").
// A layer is two passes over the blended geometry: one finds each pixel's nearest depth behind the layer before, one
// lights the surface that has it and adds it under what is there. So the order is right in every pixel, whatever that
// of the triangles, and nothing has to be sorted. Internal to the renderer.
#pragma once

#include "renderer/passes/environment.hpp"
#include "renderer/passes/gbuffer.hpp"
#include "renderer/passes/lighting.hpp"
#include "renderer/passes/shadow_maps.hpp"

namespace nacre::renderer {

class BlendedSurfaces {
public:
    /// Layers that are drawn in each pixel: what is behind them is left out.
    static constexpr std::uint32_t layerCount = 8;

    struct Inputs {
        const GpuScene& scene;
        GBuffer& gbuffer;
        Lighting& lighting;
        ShadowMaps& shadowMaps;
        Environment& environment;
        const vk::raii::Sampler& nearest;
    };

    /// The image is of one pixel where the scene has no blended surface.
    BlendedSurfaces(Gpu& gpu, const Inputs& inputs);

    /// Their radiance, each layer's times how much of it is seen, and in alpha the share of what is behind that they
    /// hide. RGBA16F.
    Image& image() { return blended_; }
    /// After the lighting of the same frame, whose first `lightCount` lights are taken.
    void record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const GpuScene& scene,
                std::uint32_t lightCount);
    template <typename Action> void forEachImage(const Action& action) {
        action(blended_);
        std::for_each(depths_.begin(), depths_.end(), action);
    }

private:
    void recordDepth(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const GpuScene& scene,
                     std::uint32_t layer);
    void recordLight(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const GpuScene& scene,
                     std::uint32_t layer, std::uint32_t lightCount);

    Image blended_;
    std::array<Image, 2> depths_;             ///< of this layer and of the one before, in turns
    std::vector<ImageUse> read_;              ///< what the shaders read beside those
    std::array<DescriptorSets, 2> depthSets_; ///< [i] reads the depths that it does not write
    DescriptorSets lightSets_;
    vk::raii::PipelineLayout depthLayout_ = nullptr;
    vk::raii::PipelineLayout lightLayout_ = nullptr;
    ReloadablePipeline depthPipeline_;
    ReloadablePipeline lightPipeline_;
};

} // namespace nacre::renderer
