// What the camera sees of surfaces that are not blended, one value per pixel: the images that lighting and the effect
// read. Internal to the renderer.
#pragma once

#include "renderer/camera.hpp"
#include "renderer/passes/gpu_scene.hpp"
#include "renderer/vulkan/reloadable_pipeline.hpp"

#include <algorithm>
#include <array>

namespace nacre::renderer {

class GBuffer {
public:
    /// Fragment outputs, in the order of the shader's locations.
    enum Attachment : std::size_t {
        Depth,         ///< R32F, linear depth in scene units; the far plane where there is nothing
        ShadingNormal, ///< RGBA16F, world space, with the normal map; w is 1 on surfaces, 0 where there is nothing
        VertexNormal,  ///< RGBA16F, world space, without the normal map; w: scale of the material's lengths
        Albedo,        ///< RGBA16F, diffuse: base colour · (1 − metallic); w: factor on the share that comes through
        Reflection,    ///< RGBA16F, F0 in rgb, GGX perceptual roughness in a
        Emission,      ///< RGBA16F; w: factor on the material's strength
        MaterialId,    ///< R16_UINT, index into Scene::materials + 1; 0 = no subsurface scattering
        /// R16F, authored thickness in mm; 0 = none. RGBA16F where surfaces have textures of the colour of what comes
        /// through: gba is that colour, negative = as the material has it.
        Transmission,
        AttachmentCount
    };

    /// `effectUsage[i]` is added to attachment i's usage: what the effect wants of the images it reads.
    GBuffer(Gpu& gpu, const GpuScene& scene, vk::Extent2D extent,
            const std::array<vk::ImageUsageFlags, AttachmentCount>& effectUsage, std::uint32_t framesInFlight);

    Image& image(Attachment attachment) { return images_[attachment]; }
    /// Views of one channel as red, as the effect reads factors: w of VertexNormal, of Albedo and of Emission.
    vk::ImageView scaleView() const { return *scaleView_; }
    vk::ImageView shareView() const { return *shareView_; }
    vk::ImageView strengthView() const { return *strengthView_; }
    /// The camera's constants, for every pass that goes from pixels to the world.
    const FrameBuffer& view() const { return view_; }
    void record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const GpuScene& scene,
                const View& view);
    template <typename Action> void forEachImage(const Action& action) {
        std::for_each(images_.begin(), images_.end(), action);
        action(hardwareDepth_);
    }

private:
    std::array<Image, AttachmentCount> images_;
    vk::raii::ImageView scaleView_ = nullptr;
    vk::raii::ImageView shareView_ = nullptr;
    vk::raii::ImageView strengthView_ = nullptr;
    Image hardwareDepth_;
    FrameBuffer view_;
    DescriptorSets sets_;
    vk::raii::PipelineLayout layout_ = nullptr;
    ReloadablePipeline opaque_;
    ReloadablePipeline masked_;
};

} // namespace nacre::renderer
