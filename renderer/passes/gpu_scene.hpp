// A scene's geometry, surfaces and textures on the device. Internal to the renderer.
#pragma once

#include "renderer/passes/shader_types.h"
#include "renderer/vulkan/descriptor_sets.hpp"
#include "scene/scene.hpp"

#include <map>
#include <tuple>

namespace nacre::renderer {

/// One instance, as it is drawn.
struct Draw {
    std::uint32_t firstIndex = 0;
    std::uint32_t indexCount = 0;
    std::int32_t vertexOffset = 0;
    std::uint32_t surface = 0;
    std::uint32_t flags = 0; ///< DrawConstants::index.w
    glm::mat4 worldFromObject{1};
    bool mirrored = false; ///< the transform turns triangles inside out
    bool doubleSided = false;
    scene::AlphaMode alphaMode = scene::AlphaMode::Opaque;
};

class GpuScene {
public:
    /// Throws RendererError naming the mesh or texture that is not consistent in itself.
    GpuScene(Gpu& gpu, const scene::Scene& scene, std::uint32_t framesInFlight);

    /// Replaces the surfaces, for frames that begin later. Throws RendererError for another number of them, and naming
    /// a surface whose textures, alphaMode or doubleSided are not what they were.
    void setSurfaces(std::span<const scene::Surface> surfaces);
    /// Before what draws frame `frame` is recorded; its previous use must have finished.
    void beginFrame(std::uint32_t frame) { constants_.write(frame, std::as_bytes(std::span(surfaceConstants_))); }
    /// Counts the changes of what a shadow map sees: here of the surfaces that have holes.
    std::uint64_t casterVersion() const { return casterVersion_; }
    /// Whether a surface with a subsurface material has an authored thickness.
    bool hasThickness() const;
    /// Whether one multiplies the lengths of its material.
    bool hasScale() const;
    /// Whether one's transmission texture multiplies the strength of its material.
    bool hasStrength() const;
    /// Whether a surface has a texture of this kind.
    bool hasTextures(std::uint32_t scene::Surface::*texture) const;
    /// shared::SurfaceConstants, one a surface.
    const FrameBuffer& surfaces() const { return constants_; }
    /// Set 1 of every pipeline that draws the scene: the textures in the order of scene::textureSlots.
    const vk::raii::DescriptorSetLayout& textureSetLayout() const { return textureSetLayout_; }

    static std::vector<vk::VertexInputBindingDescription> vertexBindings();
    static std::vector<vk::VertexInputAttributeDescription> vertexAttributes();
    /// Whether single-sided surfaces lose the triangles that face away.
    enum class Cull { BackFaces, Nothing };
    /// A pipeline for surfaces of each alpha mode; null: they are not drawn.
    struct Pipelines {
        vk::Pipeline opaque;
        vk::Pipeline masked;
        vk::Pipeline blended;
    };
    /// Draws every instance inside a rendering whose set 0 is bound. `passConstant` is handed to the shaders.
    void recordDraws(const vk::raii::CommandBuffer& commandBuffer, vk::PipelineLayout layout,
                     const Pipelines& pipelines, std::uint32_t passConstant, Cull cull) const;
    bool hasBlended() const { return !draws_.empty() && draws_.back().alphaMode == scene::AlphaMode::Blend; }

private:
    void uploadGeometry(Gpu& gpu, const scene::Scene& scene);
    void uploadTextures(Gpu& gpu, const scene::Scene& scene);
    void uploadSurfaces(Gpu& gpu, const scene::Scene& scene, std::uint32_t framesInFlight);

    std::vector<Draw> draws_; ///< in the order of scene::AlphaMode
    std::size_t materialCount_ = 0;
    std::vector<scene::Surface> surfaces_;
    std::vector<shared::SurfaceConstants> surfaceConstants_;
    std::uint64_t casterVersion_ = 0;
    Buffer positions_;
    Buffer attributes_;
    Buffer indices_;
    FrameBuffer constants_;
    std::vector<Image> textures_; ///< the scene's, then a white one
    std::map<std::tuple<scene::Wrap, scene::Wrap, bool>, vk::raii::Sampler> samplers_; ///< by wraps and `nearest`
    std::vector<const vk::raii::Sampler*> textureSamplers_;                            ///< one a texture
    vk::raii::DescriptorSetLayout textureSetLayout_ = nullptr;
    vk::raii::DescriptorPool texturePool_ = nullptr;
    std::vector<vk::raii::DescriptorSet> textureSets_; ///< one a surface
};

} // namespace nacre::renderer
