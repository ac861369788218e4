// The parameter blocks of a call, filled from its info. Each throws a Failure that names the field and its value, and
// allocates nothing else.
#pragma once

#include "interface/blocks.h"
#include "nacre/nacre.h"

#include <cstddef>

namespace nacre::effect {

/// Optional images that are given, bits 1u << NacreImageSlot.
using ImageSet = std::uint32_t;

/// albedoBefore: whether some material may apply the albedo before scattering, too.
ScatterParameters scatterParameters(const NacreScatterInfo& info, ImageSet given, const VkRect2D& area,
                                    bool albedoBefore);
/// Normals are always given.
TransmitParameters transmitParameters(const NacreTransmitInfo& info, ImageSet given, const VkRect2D& area);

/// Checks lights and the number of shadow maps. A light's map must be one of them.
void checkLights(const NacreTransmitInfo& info);
/// Fills lightCount LightParameters of lights that were checked.
void fillLights(const NacreTransmitInfo& info, std::byte* to);

/// The thesis's radius or, for 0, the default; `field` is whose it is.
std::uint32_t thesisRadius(std::uint32_t radius, const char* field);

} // namespace nacre::effect
