#include "vulkan/call_ring.hpp"

#include "contract/validation.hpp"
#include "transmit/transmit_blocks.h"
#include "vulkan/context.hpp"

#include <algorithm>

namespace nacre::effect {
namespace {

VkDeviceSize alignUp(VkDeviceSize size, VkDeviceSize alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

Owned<VkDescriptorPool> createPool(const Device& device, std::uint32_t callCount) {
    // Per call of every kind, of which compose has scatter's layout; the intermediates may be of either type.
    const auto count = [callCount](std::uint32_t perCall) { return callCount * perCall; };
    constexpr auto intermediateBindings = maxIntermediates;
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count(3)},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count(7 + 3 * intermediateBindings)},
        {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, count(17 + maxShadowMaps)},
        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, count(4 + 3 * intermediateBindings)},
    };
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = count(3);
    info.poolSizeCount = static_cast<std::uint32_t>(std::size(sizes));
    info.pPoolSizes = sizes;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(device.vk.CreateDescriptorPool(device.handle, &info, device.allocator, &pool), "vkCreateDescriptorPool");
    return {device, pool, device.vk.DestroyDescriptorPool};
}

/// Bytes of what a call takes.
struct CallBytes {
    VkDeviceSize scatter, transmit, lights;
};

CallBytes callBytes(const Context& context) {
    const VkPhysicalDeviceLimits& limits = context.device.limits;
    const VkDeviceSize alignment =
        std::max({limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment, VkDeviceSize{16}});
    return {alignUp(sizeof(ScatterParameters), alignment), alignUp(sizeof(TransmitParameters), alignment),
            alignUp(sizeof(LightParameters) * context.maxLights, alignment)};
}

} // namespace

Buffer createUniforms(const Context& context, std::uint32_t frameCount, std::uint32_t callsPerFrame) {
    const CallBytes bytes = callBytes(context);
    return createBuffer(context.device,
                        VkDeviceSize{frameCount} * callsPerFrame * (2 * bytes.scatter + bytes.transmit + bytes.lights),
                        VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "nacre parameters");
}

void createFrames(Context& context, std::uint32_t frameCount, std::uint32_t callsPerFrame) {
    const Device& device = context.device;
    const CallBytes bytes = callBytes(context);
    context.pool = createPool(device, frameCount * callsPerFrame);

    VkDeviceSize offset = 0;
    const auto place = [&](VkDescriptorBufferInfo& info, std::byte*& mapped, VkDeviceSize size) {
        info = {context.uniforms.buffer.get(), offset, size};
        mapped = context.uniforms.mapped + offset;
        offset += size;
    };
    const auto allocateSet = [&](const CallLayout& callLayout) {
        VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
        const VkDescriptorSetLayout layout = callLayout.setLayout.get();
        info.descriptorPool = context.pool.get();
        info.descriptorSetCount = 1;
        info.pSetLayouts = &layout;
        VkDescriptorSet set = VK_NULL_HANDLE;
        check(device.vk.AllocateDescriptorSets(device.handle, &info, &set), "vkAllocateDescriptorSets");
        return set;
    };
    context.frames.resize(frameCount);
    for (Frame& frame : context.frames) {
        frame.scatter.calls.resize(callsPerFrame);
        for (CallResources& call : frame.scatter.calls) {
            call.set = allocateSet(context.scatter);
            place(call.parameters, call.mappedParameters, bytes.scatter);
        }
        frame.compose.calls.resize(callsPerFrame);
        for (CallResources& call : frame.compose.calls) {
            call.set = allocateSet(context.scatter);
            place(call.parameters, call.mappedParameters, bytes.scatter);
        }
        frame.transmit.calls.resize(callsPerFrame);
        for (CallResources& call : frame.transmit.calls) {
            call.set = allocateSet(context.transmit);
            place(call.parameters, call.mappedParameters, bytes.transmit);
            place(call.lights, call.mappedLights, bytes.lights);
        }
    }
}

std::uint32_t begunFrame(const Context& context, const char* info) {
    if (!context.frame) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, info, " belongs to no frame, nacreBeginFrame comes first");
    }
    return *context.frame;
}

CallResources& nextCall(Context& context, std::uint32_t frame, FrameCalls Frame::*kind, const char* info) {
    FrameCalls& calls = context.frames[frame].*kind;
    if (calls.used == calls.calls.size()) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, info, " is one too many: frame ", frame, " already has its ", calls.used,
             " records (NacreContextInfo::recordsPerFrame)");
    }
    return calls.calls[calls.used];
}

} // namespace nacre::effect
