// The Vulkan entry points the effect uses, reached through the caller's vkGetInstanceProcAddr. No loader is linked.
#pragma once

#include <vulkan/vulkan_core.h>

namespace nacre::effect {

// clang-format off
#define NACRE_INSTANCE_FUNCTIONS(X) \
    X(GetDeviceProcAddr) X(GetPhysicalDeviceFeatures2) X(GetPhysicalDeviceMemoryProperties) \
    X(GetPhysicalDeviceProperties)
#define NACRE_DEVICE_FUNCTIONS(X) \
    X(AllocateDescriptorSets) X(AllocateMemory) X(BindBufferMemory) X(BindImageMemory) X(CmdBindDescriptorSets) \
    X(CmdBindPipeline) X(CmdDispatch) X(CmdDispatchIndirect) X(CmdPipelineBarrier) X(CmdPushConstants) \
    X(CmdWriteTimestamp) X(CreateBuffer) X(CreateComputePipelines) X(CreateDescriptorPool) X(CreateDescriptorSetLayout) X(CreateImage) \
    X(CreateImageView) X(CreatePipelineLayout) X(CreateShaderModule) X(DestroyBuffer) X(DestroyDescriptorPool) \
    X(DestroyDescriptorSetLayout) X(DestroyImage) X(DestroyImageView) X(DestroyPipeline) X(DestroyPipelineLayout) \
    X(DestroyShaderModule) X(FreeMemory) X(GetBufferMemoryRequirements) X(GetImageMemoryRequirements) X(MapMemory) \
    X(UpdateDescriptorSets)
// clang-format on

/// Members are named as the functions without "vk".
struct DispatchTable {
#define NACRE_MEMBER(name) PFN_vk##name name = nullptr;
    NACRE_INSTANCE_FUNCTIONS(NACRE_MEMBER)
    NACRE_DEVICE_FUNCTIONS(NACRE_MEMBER)
#undef NACRE_MEMBER
    /// Null where VK_EXT_debug_utils is not enabled.
    PFN_vkCmdBeginDebugUtilsLabelEXT CmdBeginDebugUtilsLabelEXT = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT CmdEndDebugUtilsLabelEXT = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT SetDebugUtilsObjectNameEXT = nullptr;
};

/// Throws EffectError (effect_error.hpp) naming the entry point that is missing.
DispatchTable loadDispatchTable(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance, VkDevice device);

} // namespace nacre::effect
