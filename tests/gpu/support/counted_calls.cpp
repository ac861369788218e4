#include "tests/gpu/support/counted_calls.hpp"

#include <string_view>
#include <type_traits>
#include <vulkan/vulkan.h>

namespace nacre::tests {
namespace {

/// A function that counts in `member` (and in `also`, if any) before it calls `real`.
template <auto real, int CallCounts::*member, int CallCounts::*also = nullptr> struct Counted;

template <typename Result, typename... Arguments, Result(VKAPI_PTR* real)(Arguments...), int CallCounts::*member,
          int CallCounts::*also>
struct Counted<real, member, also> {
    static VKAPI_ATTR Result VKAPI_CALL call(Arguments... arguments) {
        ++(callCounts().*member);
        if constexpr (also != nullptr) {
            ++(callCounts().*also);
        }
        if constexpr (std::is_void_v<Result>) {
            if (callCounts().dry) {
                return;
            }
        }
        return real(arguments...);
    }
};

template <auto real, int CallCounts::*member, int CallCounts::*also = nullptr> PFN_vkVoidFunction counted() {
    return reinterpret_cast<PFN_vkVoidFunction>(&Counted<real, member, also>::call);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL countingGetDeviceProcAddr(VkDevice device, const char* name) {
    const struct {
        std::string_view name;
        PFN_vkVoidFunction function;
    } functions[] = {
        {"vkCmdDispatch", counted<&vkCmdDispatch, &CallCounts::dispatches, &CallCounts::commands>()},
        {"vkCmdDispatchIndirect", counted<&vkCmdDispatchIndirect, &CallCounts::dispatches, &CallCounts::commands>()},
        {"vkCmdBindPipeline", counted<&vkCmdBindPipeline, &CallCounts::commands>()},
        {"vkCmdBindDescriptorSets", counted<&vkCmdBindDescriptorSets, &CallCounts::commands>()},
        {"vkCmdPipelineBarrier", counted<&vkCmdPipelineBarrier, &CallCounts::commands>()},
        {"vkCmdWriteTimestamp", counted<&vkCmdWriteTimestamp, &CallCounts::commands>()},
        {"vkCmdFillBuffer", counted<&vkCmdFillBuffer, &CallCounts::commands>()},
        {"vkCmdPushConstants", counted<&vkCmdPushConstants, &CallCounts::commands>()},
        {"vkUpdateDescriptorSets", counted<&vkUpdateDescriptorSets, &CallCounts::updates>()},
        {"vkMapMemory", counted<&vkMapMemory, &CallCounts::allocations>()},
        {"vkCreateImageView", counted<&vkCreateImageView, &CallCounts::allocations>()},
        {"vkCreateShaderModule", counted<&vkCreateShaderModule, &CallCounts::allocations>()},
        {"vkCreateComputePipelines", counted<&vkCreateComputePipelines, &CallCounts::allocations>()},
        {"vkCreateDescriptorPool", counted<&vkCreateDescriptorPool, &CallCounts::allocations>()},
        {"vkAllocateMemory", counted<&vkAllocateMemory, &CallCounts::allocations, &CallCounts::memories>()},
        {"vkAllocateDescriptorSets", counted<&vkAllocateDescriptorSets, &CallCounts::allocations>()},
        {"vkCreateBuffer", counted<&vkCreateBuffer, &CallCounts::allocations>()},
        {"vkCreateImage", counted<&vkCreateImage, &CallCounts::allocations>()},
    };
    for (const std::string_view wait : {"vkQueueSubmit", "vkQueueSubmit2", "vkQueueWaitIdle", "vkDeviceWaitIdle",
                                        "vkWaitForFences", "vkWaitSemaphores"}) {
        callCounts().waits += wait == name ? 1 : 0;
    }
    for (const auto& function : functions) {
        if (function.name == name) {
            return function.function;
        }
    }
    return vkGetDeviceProcAddr(device, name);
}

// Debug labels are instance functions without a symbol; the instance's are kept here.
PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;

VKAPI_ATTR void VKAPI_CALL countingBeginLabel(VkCommandBuffer commandBuffer, const VkDebugUtilsLabelEXT* label) {
    if (!callCounts().dry) {
        beginLabel(commandBuffer, label);
    }
}

VKAPI_ATTR void VKAPI_CALL countingEndLabel(VkCommandBuffer commandBuffer) {
    if (!callCounts().dry) {
        endLabel(commandBuffer);
    }
}

} // namespace

CallCounts& callCounts() {
    static CallCounts counts;
    return counts;
}

PFN_vkVoidFunction countingGetInstanceProcAddr(VkInstance instance, const char* name) {
    if (std::string_view(name) == "vkGetDeviceProcAddr") {
        return reinterpret_cast<PFN_vkVoidFunction>(&countingGetDeviceProcAddr);
    }
    const PFN_vkVoidFunction function = vkGetInstanceProcAddr(instance, name);
    if (function && std::string_view(name) == "vkCmdBeginDebugUtilsLabelEXT") {
        beginLabel = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(&countingBeginLabel);
    }
    if (function && std::string_view(name) == "vkCmdEndDebugUtilsLabelEXT") {
        endLabel = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(&countingEndLabel);
    }
    return function;
}

} // namespace nacre::tests
