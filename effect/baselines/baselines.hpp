// What of the baselines the rest of the effect asks for. thesis_baking.cpp has it or, in a build without them,
// left_out.cpp.
#pragma once

#include "nacre/nacre_baselines.h"

#include <cstdint>

namespace nacre::effect {

struct Context;

/// Whether a call of scatter takes the baked kernel. Throws an EffectError where it asks for one that there is not.
bool takesBakedKernel(const Context& context, const NacreScatterInfo& info);
/// nacreBakeThesisKernel.
void bakeThesisKernel(Context& context, std::uint32_t materialId, std::uint32_t radius);
/// NacreBaselineSettings::thesisTransmittance.
bool takesThesisTransmittance(const NacreTransmitInfo& info);

} // namespace nacre::effect
