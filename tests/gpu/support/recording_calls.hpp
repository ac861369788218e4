// Counts what recording must not do: calls of the renderer that make an object, submit or wait. The effect's own calls
// are counted by counted_calls.hpp.
#pragma once

#include "renderer/vulkan/open_device.hpp"
#include "tests/gpu/support/counted_calls.hpp"

#include <string>
#include <vector>

namespace nacre::tests {

/// Names of the counted functions that were called, one a call.
inline std::vector<std::string>& forbiddenCalls() {
    static std::vector<std::string> calls;
    return calls;
}

/// An entry point of the device that notes its name before it does its work.
template <auto member> struct Noted;

template <typename Result, typename... Arguments, Result (VKAPI_PTR* vk::raii::DeviceDispatcher::*member)(Arguments...)>
struct Noted<member> {
    static inline Result(VKAPI_PTR* real)(Arguments...) = nullptr;
    static inline const char* name = "";

    static VKAPI_ATTR Result VKAPI_CALL call(Arguments... arguments) {
        forbiddenCalls().emplace_back(name);
        return real(arguments...);
    }

    static void install(vk::raii::DeviceDispatcher& dispatcher, const char* functionName) {
        real = dispatcher.*member;
        name = functionName;
        dispatcher.*member = &call;
    }
};

/// From now on the device's calls are counted, the effect's by callCounts() in contexts that are made later. One device
/// of a program, once.
inline void countCalls(renderer::Device& device) {
    renderer::Gpu& gpu = device.implementation();
    auto& context = const_cast<vk::raii::ContextDispatcher&>(*gpu.context.getDispatcher());
    context.vkGetInstanceProcAddr = &countingGetInstanceProcAddr;
    auto& dispatcher = const_cast<vk::raii::DeviceDispatcher&>(*gpu.device.getDispatcher());
#define NACRE_NOTE(function) Noted<&vk::raii::DeviceDispatcher::function>::install(dispatcher, #function)
    NACRE_NOTE(vkAllocateCommandBuffers);
    NACRE_NOTE(vkAllocateDescriptorSets);
    NACRE_NOTE(vkAllocateMemory);
    NACRE_NOTE(vkCreateBuffer);
    NACRE_NOTE(vkCreateBufferView);
    NACRE_NOTE(vkCreateCommandPool);
    NACRE_NOTE(vkCreateComputePipelines);
    NACRE_NOTE(vkCreateDescriptorPool);
    NACRE_NOTE(vkCreateDescriptorSetLayout);
    NACRE_NOTE(vkCreateDescriptorUpdateTemplate);
    NACRE_NOTE(vkCreateEvent);
    NACRE_NOTE(vkCreateFence);
    NACRE_NOTE(vkCreateFramebuffer);
    NACRE_NOTE(vkCreateGraphicsPipelines);
    NACRE_NOTE(vkCreateImage);
    NACRE_NOTE(vkCreateImageView);
    NACRE_NOTE(vkCreatePipelineCache);
    NACRE_NOTE(vkCreatePipelineLayout);
    NACRE_NOTE(vkCreatePrivateDataSlot);
    NACRE_NOTE(vkCreateQueryPool);
    NACRE_NOTE(vkCreateRenderPass);
    NACRE_NOTE(vkCreateRenderPass2);
    NACRE_NOTE(vkCreateSampler);
    NACRE_NOTE(vkCreateSamplerYcbcrConversion);
    NACRE_NOTE(vkCreateSemaphore);
    NACRE_NOTE(vkCreateShaderModule);
    NACRE_NOTE(vkMapMemory);
    NACRE_NOTE(vkUpdateDescriptorSets);
    NACRE_NOTE(vkDeviceWaitIdle);
    NACRE_NOTE(vkGetQueryPoolResults);
    NACRE_NOTE(vkQueueBindSparse);
    NACRE_NOTE(vkQueueSubmit);
    NACRE_NOTE(vkQueueSubmit2);
    NACRE_NOTE(vkQueueWaitIdle);
    NACRE_NOTE(vkWaitForFences);
    NACRE_NOTE(vkWaitSemaphores);
#undef NACRE_NOTE
}

} // namespace nacre::tests
