// The lights of a call of transmission, as its pass reads them. Each throws an EffectError that names the field and its
// value.
#pragma once

#include "nacre/nacre.h"

#include <cstddef>

namespace nacre::effect {

/// Checks lights and the number of shadow maps. A light's map must be one of them.
void checkLights(const NacreTransmitInfo& info);
/// Fills lightCount LightParameters of lights that were checked.
void fillLights(const NacreTransmitInfo& info, std::byte* to);

} // namespace nacre::effect
