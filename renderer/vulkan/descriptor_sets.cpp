#include "renderer/vulkan/descriptor_sets.hpp"

#include <algorithm>
#include <iterator>

namespace nacre::renderer {
namespace {

bool isImage(vk::DescriptorType type) {
    return type == vk::DescriptorType::eCombinedImageSampler || type == vk::DescriptorType::eStorageImage;
}

const Usage& usageOf(const Binding& binding) {
    return binding.type == vk::DescriptorType::eStorageImage ? usage::computeWrite : usage::computeRead;
}

std::vector<vk::DescriptorType> typesOf(std::span<const Binding> bindings) {
    std::vector<vk::DescriptorType> types;
    std::transform(bindings.begin(), bindings.end(), std::back_inserter(types),
                   [](const Binding& binding) { return binding.type; });
    return types;
}

std::uint32_t setCount(std::span<const Binding> bindings) {
    std::uint32_t count = 1;
    for (const Binding& binding : bindings) {
        count = std::max(count, binding.frameBuffer == nullptr ? 1 : binding.frameBuffer->frames());
    }
    return count;
}

} // namespace

Binding sampled(Image& image, const vk::raii::Sampler& sampler) {
    return {.type = vk::DescriptorType::eCombinedImageSampler, .image = &image, .sampler = *sampler};
}

Binding written(Image& image, vk::ImageView view) {
    return {.type = vk::DescriptorType::eStorageImage, .image = &image, .view = view};
}

Binding uniform(const FrameBuffer& buffer) {
    return {.type = vk::DescriptorType::eUniformBuffer, .frameBuffer = &buffer};
}

Binding storage(const Buffer& buffer) {
    return {.type = vk::DescriptorType::eStorageBuffer, .buffer = buffer.handle()};
}

Binding storage(const FrameBuffer& buffer) {
    return {.type = vk::DescriptorType::eStorageBuffer, .frameBuffer = &buffer};
}

std::vector<ImageUse> imageUses(std::span<const Binding> bindings) {
    std::vector<ImageUse> uses;
    for (const Binding& binding : bindings) {
        if (isImage(binding.type)) {
            uses.push_back({*binding.image, usageOf(binding)});
        }
    }
    return uses;
}

vk::raii::DescriptorSetLayout makeSetLayout(const Gpu& gpu, std::span<const vk::DescriptorType> types,
                                            vk::ShaderStageFlags stages) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const vk::DescriptorType type : types) {
        bindings.push_back({.binding = static_cast<std::uint32_t>(bindings.size()),
                            .descriptorType = type,
                            .descriptorCount = 1,
                            .stageFlags = stages});
    }
    return {gpu.device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()}};
}

vk::raii::DescriptorPool makePool(const Gpu& gpu, std::span<const vk::DescriptorType> types, std::uint32_t sets) {
    std::vector<vk::DescriptorPoolSize> sizes;
    for (const vk::DescriptorType type : types) {
        sizes.push_back({.type = type, .descriptorCount = sets});
    }
    return {gpu.device,
            {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
             .maxSets = sets,
             .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
             .pPoolSizes = sizes.data()}};
}

vk::raii::DescriptorSet makeSet(const Gpu& gpu, const vk::raii::DescriptorPool& pool,
                                const vk::raii::DescriptorSetLayout& layout) {
    vk::raii::DescriptorSets sets(gpu.device,
                                  {.descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &*layout});
    return std::move(sets.front());
}

void writeSet(const Gpu& gpu, const vk::raii::DescriptorSet& set, std::span<const Binding> bindings,
              std::uint32_t frame) {
    std::vector<vk::DescriptorImageInfo> images(bindings.size());
    std::vector<vk::DescriptorBufferInfo> buffers(bindings.size());
    std::vector<vk::WriteDescriptorSet> writes;
    for (std::size_t i = 0; i < bindings.size(); ++i) {
        const Binding& binding = bindings[i];
        if (isImage(binding.type)) {
            images[i] = vk::DescriptorImageInfo{.sampler = binding.sampler,
                                                .imageView = binding.view ? binding.view : binding.image->view(),
                                                .imageLayout = usageOf(binding).layout};
        } else if (binding.frameBuffer != nullptr) {
            buffers[i] = binding.frameBuffer->copy(frame);
        } else {
            buffers[i] = vk::DescriptorBufferInfo{.buffer = binding.buffer, .range = VK_WHOLE_SIZE};
        }
        writes.push_back({.dstSet = *set,
                          .dstBinding = static_cast<std::uint32_t>(i),
                          .descriptorCount = 1,
                          .descriptorType = binding.type,
                          .pImageInfo = &images[i],
                          .pBufferInfo = &buffers[i]});
    }
    gpu.device.updateDescriptorSets(writes, {});
}

DescriptorSets::DescriptorSets(const Gpu& gpu, std::span<const Binding> bindings, vk::ShaderStageFlags stages) {
    const std::vector<vk::DescriptorType> types = typesOf(bindings);
    const std::uint32_t count = setCount(bindings);
    layout_ = makeSetLayout(gpu, types, stages);
    pool_ = makePool(gpu, types, count);
    for (std::uint32_t frame = 0; frame < count; ++frame) {
        sets_.push_back(makeSet(gpu, pool_, layout_));
        writeSet(gpu, sets_.back(), bindings, frame);
    }
}

} // namespace nacre::renderer
