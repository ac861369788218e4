// Whole files in and out, as nacre::files does it.
#pragma once

#include "scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace nacre::scene {

using nacre::maxFileBytes;
using nacre::readFile;
using nacre::writeFileAtomically;

} // namespace nacre::scene
