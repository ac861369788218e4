// The unit of a 3MF file, which Assimp does not read.
#pragma once

#include <filesystem>

namespace nacre::scene {

/// Metres a unit of the model in the package `file`: its attribute `unit`, a millimetre where it has none (3MF core
/// specification 1.3, 3.4). Throws SceneError naming a unit that the specification does not have.
double threemfMetersPerUnit(const std::filesystem::path& file);

} // namespace nacre::scene
