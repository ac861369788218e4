#include "vulkan/recording.hpp"

namespace nacre::effect {
namespace {

constexpr VkAccessFlags shaderAccess = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;

/// Orders everything before against everything after; the images' old contents are dropped.
void beginIntermediates(const PassRecording& recording) {
    if (recording.intermediates == 0) {
        return;
    }
    std::array<VkImageMemoryBarrier, maxIntermediates> images;
    std::uint32_t imageCount = 0;
    for (std::size_t i = 0; i < maxIntermediates; ++i) {
        const VkImage image = recording.context.intermediates[i].image.image.get();
        if ((recording.intermediates >> i & 1u) == 0 || image == VK_NULL_HANDLE) {
            continue;
        }
        VkImageMemoryBarrier& barrier = images[imageCount++];
        barrier = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
        barrier.srcAccessMask = shaderAccess;
        barrier.dstAccessMask = shaderAccess;
        barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image;
        barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    }
    VkMemoryBarrier buffers{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    buffers.srcAccessMask = shaderAccess | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    buffers.dstAccessMask = shaderAccess;
    recording.context.device.vk.CmdPipelineBarrier(
        recording.commandBuffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &buffers, 0, nullptr, imageCount, images.data());
}

/// Makes the writes of earlier passes visible to `next`. Only one that is dispatched indirectly has its arguments
/// waited for, since that takes longer.
void passBarrier(const PassRecording& recording, const Pass& next) {
    VkPipelineStageFlags stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = shaderAccess;
    if (next.isIndirect()) {
        stages |= VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
        barrier.dstAccessMask |= VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    }
    recording.context.device.vk.CmdPipelineBarrier(recording.commandBuffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                                   stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void dispatch(const PassRecording& recording, const Pass& pass) {
    const DispatchTable& vk = recording.context.device.vk;
    if (pass.isIndirect()) {
        vk.CmdDispatchIndirect(recording.commandBuffer,
                               recording.context.intermediates[pass.indirect].buffer.buffer.get(), pass.indirectOffset);
        return;
    }
    const VkExtent3D groups = pass.grid(recording.area);
    vk.CmdDispatch(recording.commandBuffer, groups.width, groups.height, groups.depth);
}

void timestamp(const PassRecording& recording, std::uint32_t index) {
    if (recording.timestamps.pool != VK_NULL_HANDLE) {
        recording.context.device.vk.CmdWriteTimestamp(recording.commandBuffer, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT,
                                                      recording.timestamps.pool,
                                                      recording.timestamps.firstQuery + index);
    }
}

void beginLabel(const PassRecording& recording, const char* name) {
    if (recording.context.device.vk.CmdBeginDebugUtilsLabelEXT) {
        VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        label.pLabelName = name;
        recording.context.device.vk.CmdBeginDebugUtilsLabelEXT(recording.commandBuffer, &label);
    }
}

void endLabel(const PassRecording& recording) {
    if (recording.context.device.vk.CmdEndDebugUtilsLabelEXT) {
        recording.context.device.vk.CmdEndDebugUtilsLabelEXT(recording.commandBuffer);
    }
}

} // namespace

VkWriteDescriptorSet& DescriptorWriter::add(std::uint32_t binding, VkDescriptorType type) {
    VkWriteDescriptorSet& write = writes_.at(writeCount_++);
    write = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = type;
    return write;
}

void DescriptorWriter::buffer(std::uint32_t binding, VkDescriptorType type, const VkDescriptorBufferInfo& info) {
    VkDescriptorBufferInfo& slot = buffers_.at(bufferCount_++);
    slot = info;
    add(binding, type).pBufferInfo = &slot;
}

void DescriptorWriter::image(std::uint32_t binding, VkDescriptorType type, VkImageView view, VkImageLayout layout) {
    VkDescriptorImageInfo& slot = images_.at(imageCount_++);
    slot = {VK_NULL_HANDLE, view, layout};
    add(binding, type).pImageInfo = &slot;
}

void DescriptorWriter::uniform(std::uint32_t binding, const VkDescriptorBufferInfo& info) {
    buffer(binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, info);
}

void DescriptorWriter::storage(std::uint32_t binding, const VkDescriptorBufferInfo& info) {
    buffer(binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, info);
}

void DescriptorWriter::sampled(std::uint32_t binding, const NacreImage& given, const NacreImage& fallback) {
    const NacreImage& used = given.view != VK_NULL_HANDLE ? given : fallback;
    image(binding, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, used.view, used.layout);
}

void DescriptorWriter::sampledArray(std::uint32_t binding, std::span<const NacreImage> given, std::uint32_t count,
                                    const NacreImage& fallback) {
    VkWriteDescriptorSet& write = add(binding, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    write.descriptorCount = count;
    write.pImageInfo = images_.data() + imageCount_;
    for (std::uint32_t i = 0; i < count; ++i) {
        const NacreImage& used = i < given.size() ? given[i] : fallback;
        images_.at(imageCount_++) = {VK_NULL_HANDLE, used.view, used.layout};
    }
}

void DescriptorWriter::output(std::uint32_t binding, const NacreImage& given) {
    image(binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, given.view, given.layout);
}

void DescriptorWriter::intermediates(const Context& context, IntermediateSet set) {
    for (std::uint32_t i = 0; i < maxIntermediates; ++i) {
        if ((set >> i & 1u) == 0) {
            continue;
        }
        const IntermediateResource& resource = context.intermediates[i];
        if (resource.buffer.buffer.get() != VK_NULL_HANDLE) {
            storage(bindingIntermediates + i, {resource.buffer.buffer.get(), 0, VK_WHOLE_SIZE});
        } else {
            image(bindingIntermediates + i, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, resource.image.view.get(),
                  VK_IMAGE_LAYOUT_GENERAL);
        }
    }
}

void DescriptorWriter::write(const Device& device) {
    device.vk.UpdateDescriptorSets(device.handle, writeCount_, writes_.data(), 0, nullptr);
}

NacreImage idsOf(const Context& context, const NacreImage& materialId) {
    return context.noMaterialIds ? NacreImage{.view = context.intermediates[intermediateNoIds].image.view.get(),
                                              .layout = VK_IMAGE_LAYOUT_GENERAL}
                                 : materialId;
}

IntermediateSet idsIntermediate(const Context& context) {
    return context.noMaterialIds ? bit(intermediateNoIds) : 0;
}

void recordPasses(const PassRecording& recording) {
    const Technique& technique = *techniques[recording.technique];
    const DispatchTable& vk = recording.context.device.vk;
    beginLabel(recording, technique.name);
    beginIntermediates(recording);
    vk.CmdBindDescriptorSets(recording.commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, recording.callLayout.layout.get(),
                             0, 1, &recording.set, 0, nullptr);
    timestamp(recording, 0);
    IntermediateSet read = 0;
    IntermediateSet written = 0;
    IntermediateSet arguments = 0; // written since an indirect dispatch's barrier
    const auto record = [&](const Pass& pass, const Owned<VkPipeline>& pipeline) {
        const bool asksArguments = pass.isIndirect() && (arguments & bit(pass.indirect)) != 0;
        if (((pass.reads | pass.writes) & written) != 0 || (pass.writes & read) != 0 || asksArguments) {
            passBarrier(recording, pass);
            read = written = 0;
            arguments = pass.isIndirect() ? 0 : arguments;
        }
        beginLabel(recording, pass.name);
        vk.CmdBindPipeline(recording.commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
        dispatch(recording, pass);
        endLabel(recording);
        read |= pass.reads;
        written |= pass.writes;
        arguments |= pass.writes;
    };
    const std::span pipelines(recording.context.pipelines[recording.technique]);
    const auto passCount = static_cast<std::uint32_t>(technique.passes.size());
    const auto push = [&](std::uint32_t value) {
        vk.CmdPushConstants(recording.commandBuffer, recording.callLayout.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                            sizeof(value), &value);
    };
    for (std::uint32_t i = 0; i < passCount; ++i) {
        const Pass& pass = technique.passes[i];
        const std::uint32_t repeats = repeatsOf(pass, recording.area);
        for (std::uint32_t repeat = 0; repeat < repeats; ++repeat) {
            if (pass.repeats) {
                push(repeat);
            }
            record(pass, pipelines[i][recording.variant & pass.constants]);
        }
        timestamp(recording, i + 1);
    }
    if (!technique.materialPasses.empty()) {
        for (std::uint32_t slot = 1; slot <= recording.materialCount; ++slot) {
            push(slot);
            for (std::size_t i = 0; i < technique.materialPasses.size(); ++i) {
                record(technique.materialPasses[i],
                       recording.baked ? recording.context.bakedPasses[i] : pipelines[passCount + i][0]);
            }
        }
        timestamp(recording, passCount + 1);
    }
    endLabel(recording);
}

} // namespace nacre::effect
