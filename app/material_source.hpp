// Materials as the command line names them.
#pragma once

#include "nacre/material.hpp"

#include <filesystem>
#include <string>

namespace nacre::app {

/// The preset of that name, else the material file. Throws UsageError when the text is neither a preset's name nor
/// looks like a file's, and what the material reader throws otherwise.
Material readMaterial(const std::string& nameOrFile);

/// The file that readMaterial reads; empty for a preset.
std::filesystem::path materialFile(const std::string& nameOrFile);

} // namespace nacre::app
