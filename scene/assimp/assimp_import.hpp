// Every format that Assimp knows.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// Reads a model through Assimp, in a child process. Formats with an up axis (Collada, FBX, Blender, 3DS) are turned to
/// +Y up, those with a unit (Collada, FBX) are scaled to metres. For the others `metersPerUnit` is the first of metre,
/// centimetre and millimetre that makes the model smaller than 5 m, and a note says so. Legacy lights have no unit:
/// each gets the intensity with which it lights the middle of the model as the file's formula says.
Scene loadWithAssimp(const std::filesystem::path& file);

/// Whether Assimp has a reader for this file name's extension.
bool assimpKnows(const std::filesystem::path& file);

} // namespace nacre::scene
