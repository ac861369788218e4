#pragma once

#include "nacre/material.hpp"

namespace nacre {

/// The twelve media of jensenMedia(), in its order.
void appendMeasuredPresets(std::vector<Material>& presets);

} // namespace nacre
