// Compose: scattered and transmitted light as one image that is added.
#include "technique.hpp"

#include "compose.spv.h"

namespace nacre::effect {
namespace {

/// Of contexts without ids, whatever the call: it is not among a pass's.
constexpr Intermediate composeIntermediates[] = {
    {.number = intermediateNoIds,
     .name = "nacre no ids",
     .format = VK_FORMAT_R32_UINT,
     .extent =
         [](VkExtent2D) {
             return VkExtent2D{1, 1};
         }},
};

constexpr Pass passes[] = {
    {.name = "nacre compose", .file = "compose", .spirv = compose_spv, .grid = tiles<16, 8>},
};

} // namespace

const Technique composeTechnique{.name = "compose", .intermediates = composeIntermediates, .passes = passes};

} // namespace nacre::effect
