#include "tests/gpu/support/counted_calls.hpp"

#include <string_view>
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
        {"vkAllocateMemory", counted<&vkAllocateMemory, &CallCounts::allocations>()},
        {"vkAllocateDescriptorSets", counted<&vkAllocateDescriptorSets, &CallCounts::allocations>()},
        {"vkCreateBuffer", counted<&vkCreateBuffer, &CallCounts::allocations>()},
        {"vkCreateImage", counted<&vkCreateImage, &CallCounts::allocations>()},
    };
    for (const auto& function : functions) {
        if (function.name == name) {
            return function.function;
        }
    }
    return vkGetDeviceProcAddr(device, name);
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
    return vkGetInstanceProcAddr(instance, name);
}

} // namespace nacre::tests
