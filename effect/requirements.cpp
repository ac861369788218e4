// What can be asked without a context.
#include "context.hpp"
#include "validation.hpp"

using namespace nacre::effect;

uint32_t nacreGetVersion(void) {
    return NACRE_HEADER_VERSION;
}

const char* nacreResultString(NacreResult result) {
    switch (result) {
#define NACRE_CASE(name)                                                                                               \
    case name:                                                                                                         \
        return #name;
        NACRE_CASE(NACRE_SUCCESS)
        NACRE_CASE(NACRE_ERROR_INVALID_ARGUMENT)
        NACRE_CASE(NACRE_ERROR_UNSUPPORTED_DEVICE)
        NACRE_CASE(NACRE_ERROR_UNSUPPORTED_FORMAT)
        NACRE_CASE(NACRE_ERROR_LIMIT_EXCEEDED)
        NACRE_CASE(NACRE_ERROR_OUT_OF_MEMORY)
        NACRE_CASE(NACRE_ERROR_VERSION_MISMATCH)
        NACRE_CASE(NACRE_ERROR_VULKAN)
#undef NACRE_CASE
    default:
        return "NACRE_ERROR_UNKNOWN";
    }
}

const char* nacreTechniqueString(NacreTechnique technique) {
    if (technique == NACRE_TECHNIQUE_DEFAULT) {
        return "default";
    }
    const auto index = static_cast<std::size_t>(technique) - 1;
    return index < scatterTechniqueCount ? techniques[index]->name : "unknown";
}

NacreResult nacreGetRequirements(NacreRequirements* requirements) {
    if (!requirements) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    *requirements = {};
    requirements->apiVersion = VK_API_VERSION_1_2;
    requirements->features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
    requirements->features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    // The larger set layout (programs.cpp): transmit has the images, scatter the buffers.
    requirements->maxPerStageDescriptorSampledImages = 5 + maxShadowMaps;
    requirements->maxPerStageDescriptorStorageImages = 3 + static_cast<uint32_t>(intermediateCount);
    requirements->maxPerStageDescriptorStorageBuffers = 3 + static_cast<uint32_t>(intermediateCount);
    return NACRE_SUCCESS;
}

NacreResult nacreGetImageRequirements(NacreImageSlot slot, NacreImageRequirements* requirements) {
    if (!requirements) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(nullptr, nullptr, [&] { *requirements = imageRequirements(slot); });
}
