// What stands at the bindings of a pass, and the descriptor sets that say so. Internal to the renderer.
#pragma once

#include "renderer/vulkan/frame_buffer.hpp"

#include <span>
#include <vector>

namespace nacre::renderer {

/// What stands at one binding of a pass: an image that is read or written, or a buffer.
struct Binding {
    vk::DescriptorType type = vk::DescriptorType::eStorageBuffer;
    Image* image = nullptr;
    vk::ImageView view; ///< null = the whole image's
    vk::Sampler sampler;
    vk::Buffer buffer;
    const FrameBuffer* frameBuffer = nullptr; ///< in place of `buffer`: the copy of the frame that is recorded
};

/// The image through a sampler.
Binding sampled(Image& image, const vk::raii::Sampler& sampler);
/// The image as a storage image that the pass overwrites.
Binding written(Image& image, vk::ImageView view = nullptr);
Binding uniform(const FrameBuffer& buffer);
Binding storage(const Buffer& buffer);
Binding storage(const FrameBuffer& buffer);

/// What a compute pass does with the images among the bindings.
std::vector<ImageUse> imageUses(std::span<const Binding> bindings);

vk::raii::DescriptorSetLayout makeSetLayout(const Gpu& gpu, std::span<const vk::DescriptorType> types,
                                            vk::ShaderStageFlags stages);
/// A pool with room for `sets` sets of these types.
vk::raii::DescriptorPool makePool(const Gpu& gpu, std::span<const vk::DescriptorType> types, std::uint32_t sets);
vk::raii::DescriptorSet makeSet(const Gpu& gpu, const vk::raii::DescriptorPool& pool,
                                const vk::raii::DescriptorSetLayout& layout);
/// Writes binding i from bindings[i], with the buffers' copies of `frame`.
void writeSet(const Gpu& gpu, const vk::raii::DescriptorSet& set, std::span<const Binding> bindings,
              std::uint32_t frame = 0);

/// What a pass binds at one set number: one set for each frame in flight, or one for all of them where no binding is a
/// FrameBuffer.
class DescriptorSets {
public:
    DescriptorSets() = default;
    DescriptorSets(const Gpu& gpu, std::span<const Binding> bindings, vk::ShaderStageFlags stages);
    DescriptorSets(DescriptorSets&&) = default;
    /// Frees the sets before their pool.
    DescriptorSets& operator=(DescriptorSets&& other) noexcept {
        sets_ = std::move(other.sets_);
        pool_ = std::move(other.pool_);
        layout_ = std::move(other.layout_);
        return *this;
    }

    vk::DescriptorSetLayout layout() const { return *layout_; }
    vk::DescriptorSet of(std::uint32_t frame) const { return *sets_[sets_.size() == 1 ? 0 : frame]; }

private:
    vk::raii::DescriptorSetLayout layout_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::vector<vk::raii::DescriptorSet> sets_;
};

} // namespace nacre::renderer
