// The small bodies of the accuracy suite, in millimetres, their scenes dark but for one light.
#pragma once

#include "scene/scene.hpp"

namespace nacre::bench {

/// An empty scene of millimetres in the dark: black surroundings and no light.
scene::Scene darkMillimetres();

/// Adds a surface of this preset with its albedo, without specular reflection, and returns its index.
std::uint32_t addPresetSurface(scene::Scene& scene, const char* preset);
/// The same of plain grey, without scattering.
std::uint32_t addGreySurface(scene::Scene& scene);
void addBody(scene::Scene& scene, scene::Mesh mesh, std::uint32_t surface, const glm::mat4& transform = glm::mat4(1));

/// A closed wedge about the origin, its faces flat: `thin` thick (along z) at x = −width / 2, `thick` at x = width / 2.
scene::Mesh wedge(float width, float height, float thin, float thick);

/// A closed sheet about the origin, bent about the vertical with this radius, its middle towards +z. Both faces have
/// smooth normals.
scene::Mesh bentSheet(float width, float height, float thickness, float radius);

scene::Light sun(const glm::vec3& direction);
/// Irradiance 3 at the origin on what faces it.
scene::Light lamp(const glm::vec3& position);
/// The same in a cone towards the origin, degrees.
scene::Light spotLamp(const glm::vec3& position, float innerConeAngle, float outerConeAngle);

/// Looks at `target` against `direction` and covers this height there.
scene::Camera cameraAt(const glm::vec3& target, const glm::vec3& direction, float height);
/// The same without perspective.
scene::Camera flatCameraAt(const glm::vec3& target, const glm::vec3& direction, float height);

} // namespace nacre::bench
