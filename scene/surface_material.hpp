// Subsurface materials in a scene, and the surfaces that have them.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// Adds a material to the scene's and returns its index: the one way into a scene, and where a scene's materials are
/// checked (`nacre::findFault`). A SceneError for one that is not valid begins with `where`.
std::uint32_t addMaterial(Scene& scene, Material material, const std::string& where);

/// Gives a surface of the scene the subsurface material of that index (or `none`), with its albedo, roughness and
/// specular where the surface has no texture for them. A blended surface that gets one becomes masked.
void setSurfaceMaterial(Scene& scene, Surface& surface, std::uint32_t material);

/// The same for every surface but the blended ones (a cornea, lashes), of which a note that begins with `where` tells;
/// for those, too, where all are blended.
void setBodyMaterial(Scene& scene, std::uint32_t material, const std::string& where);

/// Gives this subsurface material to the surfaces that have one, or as setBodyMaterial where none has (the CLI's
/// --material); it becomes the scene's only one.
void assignMaterial(Scene& scene, const Material& material);

} // namespace nacre::scene
