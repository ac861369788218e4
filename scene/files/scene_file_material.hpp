// Materials and looks that a scene file gives to the surfaces of a model.
#pragma once

#include "scene/files/scene_file_object.hpp"

namespace nacre::scene {

/// Reads `material` (for all surfaces), `materials` (by the surface's name) and `surface` and `surfaces` (looks, of all
/// and by name) of a model's entry. Material files that were read are added to the model's inputs. A material is a
/// preset's name, a material file relative to the scene file, a material in place, or null for none.
void assignMaterials(SceneFileObject& object, Scene& model);

} // namespace nacre::scene
