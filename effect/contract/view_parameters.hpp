// The caller's camera as the shaders use it.
#pragma once

#include "contract/effect_error.hpp"

#include "interface/blocks.h"
#include "nacre/nacre.h"

namespace nacre::effect {

/// Millimetres in a scene unit. Throws an EffectError naming `info`'s field.
double mmPerUnit(const NacreView& view, const FieldName& info);

/// Fills the camera's part of `parameters` from a view, its viewport and the part of it that is worked on. Throws an
/// EffectError naming `info`'s field when a matrix is no camera's. worldMatrix: whether viewFromWorld is used.
void setView(ViewParameters& parameters, const NacreView& view, const VkRect2D& viewport, const VkRect2D& area,
             bool worldMatrix, const FieldName& info);

} // namespace nacre::effect
