// Scenes back to files (docs/schemas/scene.schema.json).
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// Writes a scene file that reads back as `scene`: what was read from `source` (a model or a scene file; empty: the
/// gallery), with the scene's materials, lights, cameras, environment and exposure, and the colours, roughness and
/// specular of its surfaces. `read` has the surfaces as they were read. The file appears complete or not at all.
/// Throws FileError, also where `target` is not in the folder of the files it names or above, or would replace one of
/// the scene's other files, for surfaces of one name and model that are not alike, and for names that are not UTF-8.
void saveSceneFile(const Scene& scene, const std::vector<Surface>& read, const std::filesystem::path& source,
                   const std::filesystem::path& target);

} // namespace nacre::scene
