// A material's profile and what a slab of it lets through, as a picture.
#pragma once

#include "nacre/material.hpp"

#include <filesystem>

namespace nacre::app {

/// Throws UsageError unless the file's name ends in .png or .svg.
void checkPlotName(const std::filesystem::path& file);

/// Draws R(r) in 1/mm² on a logarithmic axis and T(d) on a linear one, both over mm, a curve a channel. The file
/// appears whole or not at all.
void plotMaterial(const Material& material, const std::filesystem::path& file);

} // namespace nacre::app
