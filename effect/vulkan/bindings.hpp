// Descriptor set 0 of a call, as data.
#pragma once

#include "technique.hpp"

#include "nacre/nacre_passes.h"

#include <vector>

namespace nacre::effect {

enum class CallKind { Scatter, Transmit };

/// What the set binds beside these intermediates, and them, for this extent. Without a technique's tables, whose stride
/// is 0.
std::vector<NacreBinding> bindingsOf(CallKind kind, IntermediateSet used, VkExtent2D maxExtent);

} // namespace nacre::effect
