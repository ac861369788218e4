// Linear-depth shadow maps of all lights: one array image, one layer per directional or spot light, six per point
// light. A texel is distance / NacreLight::shadowRange, 1 where nothing stands. Internal to the renderer.
#pragma once

#include "renderer/passes/gpu_scene.hpp"
#include "renderer/vulkan/reloadable_pipeline.hpp"

#include <optional>

namespace nacre::renderer {

class ShadowMaps {
public:
    /// Room for `layerCount` layers of `size`² texels.
    ShadowMaps(Gpu& gpu, const GpuScene& scene, std::uint32_t layerCount, std::uint32_t size,
               std::uint32_t framesInFlight);

    /// The maps, with at least one layer even when there is nothing in it. R32F.
    Image& image() { return depth_; }
    /// Draws the layers that do not hold what they should: those whose light has changed, and all where GpuScene's
    /// casterVersion has. Returns how many. `layers` are at most as many as there is room for.
    std::uint32_t record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const GpuScene& scene,
                         std::span<const shared::ShadowLayer> layers);
    /// Draws every layer next time.
    void invalidate() { drawn_.assign(drawn_.size(), std::nullopt); }
    template <typename Action> void forEachImage(const Action& action) {
        action(depth_);
        action(hardwareDepth_);
    }

private:
    std::vector<std::uint32_t> staleLayers(const GpuScene& scene, std::span<const shared::ShadowLayer> layers);
    void recordLayer(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const GpuScene& scene,
                     std::uint32_t layer);

    Image depth_;
    Image hardwareDepth_;
    FrameBuffer layers_;
    std::vector<vk::raii::ImageView> layerViews_;
    std::vector<std::optional<shared::ShadowLayer>> drawn_; ///< what each layer holds
    std::uint64_t drawnCasters_ = 0;                        ///< GpuScene::casterVersion of all of them
    DescriptorSets sets_;
    vk::raii::PipelineLayout layout_ = nullptr;
    ReloadablePipeline opaque_;
    ReloadablePipeline masked_;
};

} // namespace nacre::renderer
