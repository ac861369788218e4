// How much of its surroundings each visible surface sees. Internal to the renderer.
#pragma once

#include "renderer/passes/gbuffer.hpp"
#include "renderer/vulkan/compute_pass.hpp"

namespace nacre::renderer {

/// Share of the surroundings that reaches each visible surface past what the depth image shows.
class AmbientOcclusion {
public:
    AmbientOcclusion(Gpu& gpu, GBuffer& gbuffer, const vk::raii::Sampler& nearest);

    /// R32F, 1 where nothing is in the way.
    Image& visibility() { return visibility_; }
    /// `radius` [scene units]: how far things occlude.
    void record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, float radius) const;
    template <typename Action> void forEachImage(const Action& action) {
        action(pattern_);
        action(visibility_);
    }

private:
    Image pattern_;
    Image visibility_;
    ComputePass search_;
    ComputePass filter_;
};

} // namespace nacre::renderer
