// Compute passes as data, and graphics pipelines. Internal to the renderer.
#pragma once

#include "renderer/vulkan/resources.hpp"

#include <initializer_list>
#include <span>

namespace nacre::renderer {

/// What stands at one binding of a pass: an image that is read or written, or a buffer.
struct Binding {
    vk::DescriptorType type = vk::DescriptorType::eStorageBuffer;
    Image* image = nullptr;
    vk::ImageView view; ///< null = the whole image's
    vk::Sampler sampler;
    vk::Buffer buffer;
};

/// The image through a sampler.
Binding sampled(Image& image, const vk::raii::Sampler& sampler);
/// The image as a storage image that the pass overwrites.
Binding written(Image& image, vk::ImageView view = nullptr);
Binding uniform(const Buffer& buffer);
Binding storage(const Buffer& buffer);

/// One compute shader with its resources. Barriers and the debug label follow from the bindings.
class ComputePass {
public:
    ComputePass() = default;
    /// `bindings[i]` is binding i of set 0; the shader pushes `pushBytes` bytes and has groupSize² invocations a group.
    ComputePass(Gpu& gpu, const std::string& name, std::span<const std::uint32_t> spirv,
                const std::vector<Binding>& bindings, std::uint32_t pushBytes = 0);

    const std::string& name() const { return name_; }
    /// Covers `extent` pixels with `layers` groups in depth.
    void record(const vk::raii::CommandBuffer& commandBuffer, vk::Extent2D extent, std::span<const std::byte> push = {},
                std::uint32_t layers = 1) const;

private:
    std::string name_;
    std::vector<Binding> bindings_;
    vk::raii::DescriptorSetLayout setLayout_ = nullptr;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::Pipeline pipeline_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
};

/// The bytes of a push-constant structure.
template <typename T> std::span<const std::byte> bytesOf(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

vk::raii::DescriptorSetLayout makeSetLayout(const Gpu& gpu, std::span<const vk::DescriptorType> types,
                                            vk::ShaderStageFlags stages);
/// A pool with room for `sets` sets of these types.
vk::raii::DescriptorPool makePool(const Gpu& gpu, std::span<const vk::DescriptorType> types, std::uint32_t sets);
vk::raii::DescriptorSet makeSet(const Gpu& gpu, const vk::raii::DescriptorPool& pool,
                                const vk::raii::DescriptorSetLayout& layout);
/// Writes binding `first` + i from bindings[i].
void writeSet(const Gpu& gpu, const vk::raii::DescriptorSet& set, std::span<const Binding> bindings);

/// A pipeline for dynamic rendering: triangles, reversed depth, no blending. Viewport, scissor, cull mode and front
/// face are dynamic.
struct GraphicsPipelineInfo {
    std::string name;
    std::span<const std::uint32_t> vertexShader;
    std::span<const std::uint32_t> fragmentShader;
    std::vector<vk::VertexInputBindingDescription> vertexBindings;
    std::vector<vk::VertexInputAttributeDescription> vertexAttributes;
    std::vector<vk::Format> colorFormats;
    bool alphaMask = false; ///< specialisation constant 0 of the fragment shader
    vk::PipelineLayout layout;
};

vk::raii::Pipeline makeGraphicsPipeline(const Gpu& gpu, const GraphicsPipelineInfo& info);

/// Viewport and scissor over the whole attachment.
void setWholeViewport(const vk::raii::CommandBuffer& commandBuffer, vk::Extent2D extent);

/// Opens a debug label and closes it at the end of the scope.
class Label {
public:
    Label(const Gpu& gpu, const vk::raii::CommandBuffer& commandBuffer, const std::string& text);
    ~Label();
    Label(const Label&) = delete;
    Label& operator=(const Label&) = delete;

private:
    const vk::raii::CommandBuffer* commandBuffer_ = nullptr;
};

} // namespace nacre::renderer
