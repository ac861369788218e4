// What can be asked without a context.
#include "api/guard.hpp"
#include "contract/list.hpp"
#include "vulkan/bindings.hpp"

#include <algorithm>

namespace nacre::effect {
namespace {

/// Of a context with every technique, in the set layout that has more of them.
std::uint32_t mostDescriptors(VkDescriptorType type) {
    std::uint32_t most = 0;
    for (const CallKind kind : {CallKind::Scatter, CallKind::Transmit}) {
        IntermediateSet used = 0;
        for (std::size_t i = 0; i < techniqueCount; ++i) {
            used |= (i == transmitIndex) == (kind == CallKind::Transmit) ? techniques[i]->uses() : 0;
        }
        std::uint32_t count = 0;
        for (const NacreBinding& binding : bindingsOf(kind, used, {1, 1})) {
            count += binding.type == type ? binding.count : 0;
        }
        most = std::max(most, count);
    }
    return most;
}

} // namespace
} // namespace nacre::effect

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
        NACRE_CASE(NACRE_ERROR_UNSUPPORTED)
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
    return index < scatterTechniqueCount && techniques[index]->isBuilt() ? techniques[index]->name : "unknown";
}

NacreResult nacreGetTechniques(uint32_t* count, NacreTechnique* techniquesOut) {
    return guard(nullptr, nullptr, [&] {
        std::vector<NacreTechnique> list;
        for (const bool baseline : {false, true}) {
            for (std::size_t i = 0; i < scatterTechniqueCount; ++i) {
                if (techniques[i]->isBuilt() && techniques[i]->isBaseline == baseline) {
                    list.push_back(static_cast<NacreTechnique>(i + 1));
                }
            }
        }
        handOver(std::span<const NacreTechnique>(list), count, techniquesOut, "techniqueCount");
    });
}

NacreResult nacreGetRequirements(NacreRequirements* requirements) {
    if (!requirements) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    *requirements = {};
    requirements->apiVersion = VK_API_VERSION_1_2;
    requirements->features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
    requirements->features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    requirements->maxPerStageDescriptorSampledImages = mostDescriptors(VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    requirements->maxPerStageDescriptorStorageImages = mostDescriptors(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    requirements->maxPerStageDescriptorStorageBuffers = mostDescriptors(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    return NACRE_SUCCESS;
}

NacreResult nacreGetImageRequirements(NacreImageSlot slot, NacreImageRequirements* requirements) {
    if (!requirements) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(nullptr, nullptr, [&] { *requirements = imageRequirements(slot); });
}
