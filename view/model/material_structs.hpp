// A material as the source text of an engine.
#pragma once

#include "nacre/material.hpp"

#include <string>

namespace nacre::view {

/// Definitions of a NacreLayer array and of the NacreMaterial that points to it (nacre.h), in C99.
std::string structsOf(const Material& material);

} // namespace nacre::view
