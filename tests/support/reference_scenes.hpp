// Small scenes in millimetres for the references: planes, slabs, balls, plates that cast shadows.
#pragma once

#include "scene/scene.hpp"

namespace nacre::test {

/// An empty scene of millimetres in the dark: no lights, black surroundings.
scene::Scene darkScene();

/// Adds a surface of this subsurface material with a white base colour; without one, a plain grey surface.
std::uint32_t addSurface(scene::Scene& scene, const Material* material);

/// A material of Burley's profile, albedo 1.
Material burleyMaterial(const Rgb& meanFreePath);

void addMesh(scene::Scene& scene, scene::Mesh mesh, std::uint32_t surface, const glm::mat4& transform = glm::mat4(1));

/// The rectangle from low to high in x and z at height y, facing up.
scene::Mesh rectangle(const glm::vec2& low, const glm::vec2& high, float y);
/// A flat ring about the y axis at height y, facing up.
scene::Mesh ring(float innerRadius, float outerRadius, float y, int segments = 256);
/// A closed box, faces outwards.
scene::Mesh box(const glm::vec3& low, const glm::vec3& high);
/// A closed ball of triangles with smooth normals, its vertices on the sphere.
scene::Mesh ball(float radius, int rings = 96);

/// Irradiance 1 on what faces it.
scene::Light directionalLight(const glm::vec3& direction);
/// The same radiance from everywhere.
scene::Environment evenSurroundings(float radiance);

/// An orthographic camera that looks down from y = 100 at the square of this side about the origin.
scene::Camera downwardCamera(float side);

} // namespace nacre::test
