// The lights of a call of transmission, as its pass reads them. Each throws an EffectError that names the field and its
// value.
#pragma once

#include "technique.hpp"

#include <cstddef>
#include <cstdint>

namespace nacre::effect {

/// Checks lights and the number of shadow maps. A light's map must be one of them.
void checkLights(const NacreTransmitInfo& info);
/// How many LightParameters they take: one a light, then one a cascade.
std::uint32_t lightElementCount(const NacreTransmitInfo& info);
/// The constants that the call's pass has to have.
Variant variantOf(const NacreTransmitInfo& info, ImageSet given);
/// Fills lightElementCount LightParameters of lights that were checked.
void fillLights(const NacreTransmitInfo& info, std::byte* to);

} // namespace nacre::effect
