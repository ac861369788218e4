// Linear-depth shadow maps of all lights: one array image, one layer per directional or spot light, six per point
// light. A texel is distance / PlacedLight::shadowRange, 1 where nothing stands. Internal to the renderer.
#pragma once

#include "renderer/passes/gpu_scene.hpp"
#include "renderer/light_placement.hpp"

namespace nacre::renderer {

class ShadowMaps {
public:
    ShadowMaps(Gpu& gpu, const GpuScene& scene, std::span<const shared::ShadowLayer> layers, std::uint32_t size);

    /// The maps, with at least one layer even when there is nothing in it. R32F.
    Image& image() { return depth_; }
    void record(const vk::raii::CommandBuffer& commandBuffer, const GpuScene& scene);

private:
    Image depth_;
    Image hardwareDepth_;
    Buffer layers_;
    std::vector<vk::raii::ImageView> layerViews_;
    vk::raii::DescriptorSetLayout setLayout_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::Pipeline opaque_ = nullptr;
    vk::raii::Pipeline masked_ = nullptr;
};

} // namespace nacre::renderer
