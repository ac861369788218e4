// Small scenes in millimetres for the references: planes, slabs, balls, plates that cast shadows.
#pragma once

#include "scene/primitive_meshes.hpp"

namespace nacre::test {

/// An empty scene of millimetres in the dark: no lights, black surroundings.
scene::Scene darkScene();

/// Adds a surface of this subsurface material with a white base colour; without one, a plain grey surface.
std::uint32_t addSurface(scene::Scene& scene, const Material* material);

/// A material of Burley's profile, albedo 1.
Material burleyMaterial(const Rgb& meanFreePath);

void addMesh(scene::Scene& scene, scene::Mesh mesh, std::uint32_t surface, const glm::mat4& transform = glm::mat4(1));

using scene::ball;
using scene::box;
using scene::rectangle;
using scene::ring;

/// Irradiance 1 on what faces it.
scene::Light directionalLight(const glm::vec3& direction);
/// The same radiance from everywhere.
scene::Environment evenSurroundings(float radiance);

/// An orthographic camera that looks down from y = 100 at the square of this side about the origin.
scene::Camera downwardCamera(float side);

} // namespace nacre::test
