// A scene's geometry, surfaces and textures on the device. Internal to the renderer.
#pragma once

#include "renderer/vulkan/pipelines.hpp"
#include "renderer/passes/shader_types.h"
#include "scene/scene.hpp"

namespace nacre::renderer {

/// One instance, as it is drawn.
struct Draw {
    std::uint32_t firstIndex = 0;
    std::uint32_t indexCount = 0;
    std::int32_t vertexOffset = 0;
    std::uint32_t surface = 0;
    std::uint32_t flags = 0; ///< shared::hasBaseColorTexture and the like
    glm::mat4 worldFromObject{1};
    bool mirrored = false; ///< the transform turns triangles inside out
    bool doubleSided = false;
    bool alphaMask = false;
};

class GpuScene {
public:
    /// Throws RendererError naming the mesh or texture that is not consistent in itself.
    GpuScene(Gpu& gpu, const scene::Scene& scene);

    const std::vector<Draw>& draws() const { return draws_; }
    const Buffer& surfaces() const { return surfaces_; }
    /// Set 1 of every pipeline that draws the scene: base colour, normal, metallic-roughness, thickness textures.
    const vk::raii::DescriptorSetLayout& textureSetLayout() const { return textureSetLayout_; }

    static std::vector<vk::VertexInputBindingDescription> vertexBindings();
    static std::vector<vk::VertexInputAttributeDescription> vertexAttributes();
    /// Whether single-sided surfaces lose the triangles that face away.
    enum class Cull { BackFaces, Nothing };
    /// Draws every instance, alpha-masked ones with their own pipeline, inside a rendering whose set 0 is bound.
    /// `shadowLayer` is handed to the shaders.
    void recordDraws(const vk::raii::CommandBuffer& commandBuffer, vk::PipelineLayout layout, vk::Pipeline opaque,
                     vk::Pipeline masked, std::uint32_t shadowLayer, Cull cull) const;

private:
    void uploadGeometry(Gpu& gpu, const scene::Scene& scene);
    void uploadTextures(Gpu& gpu, const scene::Scene& scene);
    void uploadSurfaces(Gpu& gpu, const scene::Scene& scene);

    std::vector<Draw> draws_;
    Buffer positions_;
    Buffer attributes_;
    Buffer indices_;
    Buffer surfaces_;
    std::vector<Image> textures_; ///< the scene's, then a white one
    vk::raii::Sampler repeatSampler_ = nullptr;
    vk::raii::Sampler clampSampler_ = nullptr;
    vk::raii::DescriptorSetLayout textureSetLayout_ = nullptr;
    vk::raii::DescriptorPool texturePool_ = nullptr;
    std::vector<vk::raii::DescriptorSet> textureSets_; ///< one a surface
};

} // namespace nacre::renderer
