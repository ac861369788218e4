// One pipeline for all contexts of a test program that ask for the same one. A software device (Mesa) reads a pass, and
// compiles it for every combination of formats, anew for each pipeline, which a pipeline cache does not spare it; under
// the validation layers that takes longer than what most tests do with the pipeline.
#pragma once

#include <vulkan/vulkan_core.h>

namespace nacre::tests {

/// As vkGetInstanceProcAddr. A compute pipeline is the same where SPIR-V, constants, descriptor bindings and push
/// constants are; it lives until destroySharedPipelines. Those made with an allocator or a pipeline cache are made as
/// ever.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL sharingGetInstanceProcAddr(VkInstance instance, const char* name);

/// Before the device is destroyed.
void destroySharedPipelines(VkDevice device);

} // namespace nacre::tests
