// The pose that a glTF animation has at a time.
#pragma once

#include "scene/gltf/gltf_file.hpp"

namespace nacre::scene {

/// Gives the nodes the translations, rotations, scales and morph weights that the file's first animation has at `time`
/// [s]; before its first key and after its last one a channel has these. A note tells of channels that are not read, of
/// other animations, and of a file without any. Throws SceneError for an animation that is not valid.
void poseAt(GltfFile& file, double time);

} // namespace nacre::scene
