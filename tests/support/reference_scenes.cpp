#include "tests/support/reference_scenes.hpp"

namespace nacre::test {

using scene::Mesh;
using scene::Scene;

Scene darkScene() {
    Scene scene;
    scene.name = "test";
    scene.metersPerUnit = 0.001;
    scene.environment = evenSurroundings(0);
    return scene;
}

std::uint32_t addSurface(Scene& scene, const Material* material) {
    scene::Surface surface;
    surface.baseColor = material ? glm::vec4(1) : glm::vec4(0.5f, 0.5f, 0.5f, 1);
    if (material) {
        surface.material = static_cast<std::uint32_t>(scene.materials.size());
        scene.materials.push_back(*material);
    }
    scene.surfaces.push_back(surface);
    return static_cast<std::uint32_t>(scene.surfaces.size() - 1);
}

Material burleyMaterial(const Rgb& meanFreePath) {
    Material material;
    material.name = "burley";
    material.meanFreePath = meanFreePath;
    material.albedo = {1, 1, 1};
    return material;
}

void addMesh(Scene& scene, Mesh mesh, std::uint32_t surface, const glm::mat4& transform) {
    mesh.surface = surface;
    scene.instances.push_back({mesh.name, static_cast<std::uint32_t>(scene.meshes.size()), transform});
    scene.meshes.push_back(std::move(mesh));
}

scene::Light directionalLight(const glm::vec3& direction) {
    scene::Light light;
    light.name = "sun";
    light.direction = direction;
    return light;
}

scene::Environment evenSurroundings(float radiance) {
    scene::Environment environment;
    environment.zenith = environment.horizon = environment.ground = glm::vec3(radiance);
    return environment;
}

scene::Camera downwardCamera(float side) {
    scene::Camera camera;
    camera.name = "above";
    camera.position = {0, 100, 0};
    camera.target = {0, 0, 0};
    camera.up = {0, 0, -1};
    camera.projection = scene::ProjectionKind::Orthographic;
    camera.orthographicHeight = side;
    return camera;
}

} // namespace nacre::test
