// Counts the Vulkan calls a context makes, by handing it entry points that count and pass on.
#pragma once

#include <vulkan/vulkan_core.h>

namespace nacre::tests {

/// Calls since the last reset, by every context made with countingGetInstanceProcAddr.
struct CallCounts {
    int dispatches = 0;  ///< vkCmdDispatch, vkCmdDispatchIndirect
    int commands = 0;    ///< every vkCmd… the effect knows, dispatches included
    int allocations = 0; ///< vkAllocate…, vkCreate…, vkMapMemory
    int memories = 0;    ///< vkAllocateMemory
    int updates = 0;     ///< vkUpdateDescriptorSets
    int waits = 0;       ///< how often a function that submits or waits was asked for
    bool dry = false;    ///< calls without a result are counted and go no further
};

CallCounts& callCounts();
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL countingGetInstanceProcAddr(VkInstance instance, const char* name);

} // namespace nacre::tests
