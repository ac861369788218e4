// Materials and looks that a scene file gives to the surfaces of a model.
#pragma once

#include "scene/files/scene_file_object.hpp"
#include "scene/scene.hpp"

#include <array>

namespace nacre::scene {

/// A texture that a look can name.
struct LookTexture {
    const char* key;
    std::uint32_t Surface::*texture;
    bool srgb;
};
inline constexpr std::array lookTextures{
    LookTexture{"thicknessTexture", &Surface::thicknessTexture, false},
    LookTexture{"scaleTexture", &Surface::scaleTexture, false},
    LookTexture{"transmissionTexture", &Surface::transmissionTexture, false},
    LookTexture{"transmissionColorTexture", &Surface::transmissionColorTexture, true}};

/// Reads `material` (for all surfaces), `materials` (by the surface's name) and `surface` and `surfaces` (looks, of all
/// and by name) of a model's entry. Material files that were read are added to the model's inputs. A material is a
/// preset's name, a material file relative to the scene file, a material in place, or null for none.
void assignMaterials(SceneFileObject& object, Scene& model);

} // namespace nacre::scene
