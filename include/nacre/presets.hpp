// Materials to start from.
#pragma once

#include "nacre/material.hpp"

#include <string_view>

namespace nacre {

/// Every preset, in the order they are listed to users: skin and marble as published, Jensen's twelve measured media,
/// then those chosen by eye (their descriptions say so). All are free of faults and their names differ.
std::span<const Material> presets();

/// The preset of this name, or null.
const Material* findPreset(std::string_view name);

} // namespace nacre
