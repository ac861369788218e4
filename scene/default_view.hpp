// What a scene needs to be looked at.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// Adds a camera that sees all of the scene (when it has none) and key, fill and back light (when it has none).
void addMissingViewAndLights(Scene& scene);

/// The lights that addMissingViewAndLights would add; the scene has a camera.
std::vector<Light> builtInLights(const Scene& scene);

/// Whether the light shines on the side of a scene with this `center` that the camera sees.
bool isInFront(const Light& light, const Camera& camera, const glm::vec3& center);

/// Scales the lights' intensities, all by the same factor, where they would leave a white surface in the middle of the
/// scene more than four times too bright or too dark: exporters write anything from 1 to 100,000 lux, the renderer
/// keeps light in half floats, and the sky and the built-in lights are of the order of 1.
void fitLights(Scene& scene);

} // namespace nacre::scene
