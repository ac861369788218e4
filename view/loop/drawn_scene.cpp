#include "view/loop/drawn_scene.hpp"

namespace nacre::view {

DrawnScene::DrawnScene(const scene::Scene& scene)
    : materials(scene.materials),
      surfaces(scene.surfaces),
      lights(scene.lights),
      environmentIntensity(scene.environment.intensity),
      environmentRotation(scene.environment.rotation) {}

void DrawnScene::apply(renderer::Frame& frame) const {
    frame.setMaterials(materials);
    frame.setSurfaces(surfaces);
    frame.setLights(lights);
    frame.setEnvironment(environmentIntensity, environmentRotation);
}

} // namespace nacre::view
