#include "technique.hpp"

namespace nacre::effect {

const std::array<IntermediateInfo, intermediateCount> intermediates{{
    {.name = "nacre separable rows",
     .format = VK_FORMAT_R16G16B16A16_SFLOAT,
     .extent = [](VkExtent2D extent) { return extent; }},
    {.name = "nacre brute pixels",
     .bytes = [](VkExtent2D extent) { return VkDeviceSize{sizeof(BrutePixel)} * extent.width * extent.height; }},
    {.name = "nacre no shadow map",
     .format = VK_FORMAT_R32_SFLOAT,
     .extent =
         [](VkExtent2D) {
             return VkExtent2D{1, 1};
         },
     .array = true},
    {.name = "nacre bank raw pyramid", .bytes = bankRawBytes},
    {.name = "nacre bank blurred pyramid", .bytes = bankBlurredBytes},
    {.name = "nacre bank borrowed surfaces", .bytes = bankBlurredBytes},
    {.name = "nacre bank areas", .bytes = bankAreaBytes},
    {.name = "nacre bank tiles", .bytes = bankTileBytes},
    {.name = "nacre bank materials", .bytes = bankMaterialBytes},
    {.name = "nacre bank second surfaces", .bytes = bankSecondBytes},
}};

const std::array<const Technique*, techniqueCount> techniques{
    &separableTechnique, &bruteTechnique,        &bankTechnique,    &burleyTechnique,
    &thesisTechnique,    &bankSurfacesTechnique, &transmitTechnique};

IntermediateSet Technique::uses() const {
    IntermediateSet set = 0;
    for (const std::span<const Pass> part : {passes, materialPasses}) {
        for (const Pass& pass : part) {
            set |= pass.reads | pass.writes;
        }
    }
    return set;
}

} // namespace nacre::effect
