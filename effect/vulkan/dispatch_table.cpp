#include "vulkan/dispatch_table.hpp"

#include "contract/effect_error.hpp"

namespace nacre::effect {

DispatchTable loadDispatchTable(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance, VkDevice device) {
    DispatchTable table;
    const auto require = [](PFN_vkVoidFunction function, const char* name) {
        if (!function) {
            fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreContextInfo::getInstanceProcAddr does not know ", name);
        }
        return function;
    };
#define NACRE_LOAD(name)                                                                                               \
    table.name = reinterpret_cast<PFN_vk##name>(require(getInstanceProcAddr(instance, "vk" #name), "vk" #name));
    NACRE_INSTANCE_FUNCTIONS(NACRE_LOAD)
#undef NACRE_LOAD
#define NACRE_LOAD(name)                                                                                               \
    table.name = reinterpret_cast<PFN_vk##name>(require(table.GetDeviceProcAddr(device, "vk" #name), "vk" #name));
    NACRE_DEVICE_FUNCTIONS(NACRE_LOAD)
#undef NACRE_LOAD
    // Instance-level look-up: it answers null when the extension is not enabled.
#define NACRE_LOAD(name) table.name = reinterpret_cast<PFN_vk##name>(getInstanceProcAddr(instance, "vk" #name));
    NACRE_LOAD(CmdBeginDebugUtilsLabelEXT)
    NACRE_LOAD(CmdEndDebugUtilsLabelEXT)
    NACRE_LOAD(SetDebugUtilsObjectNameEXT)
#undef NACRE_LOAD
    return table;
}

} // namespace nacre::effect
