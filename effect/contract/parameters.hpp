// The parameter blocks of a call, filled from its info. Each throws an EffectError that names the field and its value,
// and allocates nothing else.
#pragma once

#include "interface/blocks.h"
#include "nacre/nacre.h"
#include "transmit/transmit_blocks.h"

namespace nacre::effect {

/// Optional images that are given, bits 1u << NacreImageSlot.
using ImageSet = std::uint32_t;

/// albedoBefore: whether some material may apply the albedo before scattering, too.
ScatterParameters scatterParameters(const NacreScatterInfo& info, ImageSet given, const VkRect2D& area,
                                    bool albedoBefore);
/// Normals are always given.
TransmitParameters transmitParameters(const NacreTransmitInfo& info, ImageSet given, const VkRect2D& area);
/// Of the view only what is worked on, since compose asks for no place.
ScatterParameters composeParameters(const NacreComposeInfo& info, ImageSet given, const VkRect2D& area);

} // namespace nacre::effect
