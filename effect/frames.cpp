// The ring of descriptor sets and uniform memory: one of each per call and frame in flight.
#include "context.hpp"

#include "validation.hpp"

#include <algorithm>

namespace nacre::effect {
namespace {

VkDeviceSize alignUp(VkDeviceSize size, VkDeviceSize alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

Owned<VkDescriptorPool> createPool(const Device& device, std::uint32_t recordCount) {
    // Per record of either kind; the intermediates may be of either type.
    const auto count = [recordCount](std::uint32_t perRecord) { return recordCount * perRecord; };
    constexpr auto intermediateBindings = static_cast<std::uint32_t>(intermediateCount);
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count(2)},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count(5 + 2 * intermediateBindings)},
        {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, count(11 + maxShadowMaps)},
        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, count(3 + 2 * intermediateBindings)},
    };
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = count(2);
    info.poolSizeCount = static_cast<std::uint32_t>(std::size(sizes));
    info.pPoolSizes = sizes;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(device.vk.CreateDescriptorPool(device.handle, &info, device.allocator, &pool), "vkCreateDescriptorPool");
    return {device, pool, device.vk.DestroyDescriptorPool};
}

} // namespace

void createFrames(Context& context, std::uint32_t frameCount, std::uint32_t recordsPerFrame) {
    const Device& device = context.device;
    const VkDeviceSize alignment = std::max({device.limits.minUniformBufferOffsetAlignment,
                                             device.limits.minStorageBufferOffsetAlignment, VkDeviceSize{16}});
    const VkDeviceSize scatterBytes = alignUp(sizeof(ScatterParameters), alignment);
    const VkDeviceSize transmitBytes = alignUp(sizeof(TransmitParameters), alignment);
    const VkDeviceSize lightBytes = alignUp(sizeof(LightParameters) * context.maxLights, alignment);
    const std::uint32_t recordCount = frameCount * recordsPerFrame;
    context.uniforms =
        createHostBuffer(device, recordCount * (scatterBytes + transmitBytes + lightBytes),
                         VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "nacre parameters");
    context.pool = createPool(device, recordCount);

    VkDeviceSize offset = 0;
    const auto place = [&](VkDescriptorBufferInfo& info, std::byte*& mapped, VkDeviceSize bytes) {
        info = {context.uniforms.buffer.get(), offset, bytes};
        mapped = context.uniforms.mapped + offset;
        offset += bytes;
    };
    const auto allocateSet = [&](const Programs& programs) {
        VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
        const VkDescriptorSetLayout layout = programs.setLayout.get();
        info.descriptorPool = context.pool.get();
        info.descriptorSetCount = 1;
        info.pSetLayouts = &layout;
        VkDescriptorSet set = VK_NULL_HANDLE;
        check(device.vk.AllocateDescriptorSets(device.handle, &info, &set), "vkAllocateDescriptorSets");
        return set;
    };
    context.frames.resize(frameCount);
    for (Frame& frame : context.frames) {
        frame.scatter.records.resize(recordsPerFrame);
        for (Record& record : frame.scatter.records) {
            record.set = allocateSet(context.scatter);
            place(record.parameters, record.mappedParameters, scatterBytes);
        }
        frame.transmit.records.resize(recordsPerFrame);
        for (Record& record : frame.transmit.records) {
            record.set = allocateSet(context.transmit);
            place(record.parameters, record.mappedParameters, transmitBytes);
            place(record.lights, record.mappedLights, lightBytes);
        }
    }
}

Record& nextRecord(Context& context, std::uint32_t frame, Records Frame::*kind, const char* info) {
    if (frame >= context.frames.size()) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, info, "::frame is ", frame, ", the context has ", context.frames.size(),
             " frames in flight");
    }
    if (!context.frames[frame].begun) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, info, "::frame is ", frame, ", which nacreBeginFrame has not begun");
    }
    Records& records = context.frames[frame].*kind;
    if (records.used == records.records.size()) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, info, "::frame is ", frame, ", which already has its ", records.used,
             " records (NacreContextInfo::recordsPerFrame)");
    }
    return records.records[records.used];
}

} // namespace nacre::effect
