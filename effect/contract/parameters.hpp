// The parameter blocks of a call, filled from its info. Each throws an EffectError that names the field and its value,
// and allocates nothing else.
#pragma once

#include "interface/blocks.h"
#include "technique.hpp"
#include "transmit/transmit_blocks.h"

namespace nacre::effect {

/// What a call asks of its passes. haveSeparate: some materials do not exchange light with some others;
/// havePartialStrength: some have a strength below 1.
constexpr Variant scatterVariant(ImageSet given, bool haveSeparate, bool havePartialStrength) {
    constexpr ImageSet asking = 1u << NACRE_IMAGE_ALBEDO | 1u << NACRE_IMAGE_STRENGTH | 1u << NACRE_IMAGE_SCALE;
    return (haveSeparate ? separateMaterials : 0) |
           ((given & asking) != 0 || havePartialStrength ? albedoOrFactors : 0);
}
/// albedoBefore: whether some material may apply the albedo before scattering, too.
ScatterParameters scatterParameters(const NacreScatterInfo& info, ImageSet given, const VkRect2D& area,
                                    bool albedoBefore);
/// Normals are always given.
TransmitParameters transmitParameters(const NacreTransmitInfo& info, ImageSet given, const VkRect2D& area);
/// Of the view only what is worked on, since compose asks for no place.
ScatterParameters composeParameters(const NacreComposeInfo& info, ImageSet given, const VkRect2D& area);

} // namespace nacre::effect
