// What Assimp does not read of a 3MF file: its unit, and colours of its materials extension.
#pragma once

#include <filesystem>

namespace nacre::scene {

struct ThreemfFacts {
    double metersPerUnit = 1e-3;
    bool hasUnreadColors = false; ///< colour groups or textures, at its beginning
};

/// Metres a unit of the model in the package `file`: its attribute `unit`, a millimetre where it has none (3MF core
/// specification 1.3, 3.4). Throws SceneError naming a unit that the specification does not have.
ThreemfFacts readThreemfFacts(const std::filesystem::path& file);

} // namespace nacre::scene
