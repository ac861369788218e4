// Compute passes as data. Internal to the renderer.
#pragma once

#include "renderer/vulkan/descriptor_sets.hpp"
#include "renderer/vulkan/reloadable_pipeline.hpp"

#include <span>
#include <string>
#include <vector>

namespace nacre::renderer {

/// One compute shader with its resources. Barriers follow from the bindings, which must stay where they are.
class ComputePass {
public:
    ComputePass() = default;
    /// `bindings[i]` is binding i of set 0; the shader pushes `pushBytes` bytes and has groupSize² invocations a group.
    ComputePass(Gpu& gpu, const std::string& name, const EmbeddedShader& shader, const std::vector<Binding>& bindings,
                std::uint32_t pushBytes = 0);

    /// Covers `extent` pixels with `layers` groups in depth. `frame` chooses the copies of FrameBuffers.
    void record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, vk::Extent2D extent,
                std::span<const std::byte> push = {}, std::uint32_t layers = 1) const;

private:
    std::vector<ImageUse> uses_;
    DescriptorSets sets_;
    vk::raii::PipelineLayout layout_ = nullptr;
    ReloadablePipeline pipeline_;
};

/// The bytes of a structure of constants.
template <typename T> std::span<const std::byte> bytesOf(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

} // namespace nacre::renderer
