// The scene of the viewer's tests.
#pragma once

#include "nacre/presets.hpp"
#include "tests/gpu/support/renderer_scenes.hpp"

namespace nacre::tests {

/// A ball of the first preset over a ground without a material, a light in front of and one behind it.
inline scene::Scene ballScene() {
    scene::Scene scene = darkScene(3);
    scene.environment.intensity = 0.2f;
    scene.metersPerUnit = 0.02;
    scene.materials = {presets().front()};
    add(scene, square(4), glm::translate(glm::mat4(1), {0, 0, -0.6f}));
    add(scene, sphere(0.5f, 12)).material = 0;
    scene.lights = {directional({0.3f, -0.5f, -1}, 2), directional({0.1f, -0.2f, 1}, 2)};
    return scene;
}

} // namespace nacre::tests
