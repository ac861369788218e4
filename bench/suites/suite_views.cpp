#include "bench/suites/suite_views.hpp"

#include "app/render_scene.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace nacre::bench {
namespace {

constexpr float closeUpFieldOfView = 0.35f;

app::SceneOptions optionsOf(const std::filesystem::path& file) {
    app::SceneOptions options;
    options.input = file;
    return options;
}

// With all of its lights.
scene::Scene loadScene(const app::SceneOptions& options) {
    scene::Scene scene = app::makeScene(options);
    if (scene.materials.empty()) {
        throw std::runtime_error(app::sceneName(options) + ": has no subsurface material to measure");
    }
    return scene;
}

std::shared_ptr<const View> litFrom(const char* side, scene::Scene scene, app::SceneOptions options) {
    options.lights = {side};
    app::chooseLights(options, scene);
    const scene::Camera camera = makeCamera(options, scene);
    return std::make_shared<View>(
        View{app::sceneName(options) + ", " + side, std::make_shared<scene::Scene>(std::move(scene)), camera});
}

} // namespace

scene::Bounds boundsOf(const scene::Scene& scene, const scene::Instance& instance) {
    scene::Bounds bounds;
    for (const scene::Vertex& vertex : scene.meshes[instance.mesh].vertices) {
        const glm::vec3 position = instance.transform * glm::vec4(vertex.position, 1);
        bounds.low = glm::min(bounds.low, position);
        bounds.high = glm::max(bounds.high, position);
    }
    return bounds;
}

scene::Camera lookAt(const scene::Bounds& bounds, const scene::Camera& from) {
    scene::Camera camera = from;
    const glm::vec3 direction = glm::normalize(from.position - from.target);
    const float halfHeight = 0.45f * (bounds.high.y - bounds.low.y) + 1e-6f;
    camera.projection = scene::ProjectionKind::Perspective;
    camera.verticalFieldOfView = closeUpFieldOfView;
    camera.target = bounds.center();
    camera.position = camera.target + direction * (halfHeight / std::tan(closeUpFieldOfView / 2) + bounds.radius());
    camera.nearPlane = 0;
    camera.farPlane = 0;
    return camera;
}

std::shared_ptr<const View> makeView(const std::filesystem::path& file, const char* side) {
    const app::SceneOptions options = optionsOf(file);
    return litFrom(side, loadScene(options), options);
}

Views makeViews(const std::filesystem::path& file) {
    const app::SceneOptions options = optionsOf(file);
    scene::Scene scene = loadScene(options);
    return {litFrom("front", scene, options), litFrom("back", std::move(scene), options)};
}

std::vector<std::shared_ptr<const View>> closeUps(const std::shared_ptr<const View>& view, std::size_t count) {
    const scene::Scene& scene = *view->scene;
    std::vector<const scene::Instance*> bodies;
    for (const scene::Instance& instance : scene.instances) {
        if (scene.surfaces[scene.meshes[instance.mesh].surface].material != scene::none) {
            bodies.push_back(&instance);
        }
    }
    const auto triangles = [&](const scene::Instance* body) { return scene.meshes[body->mesh].indices.size(); };
    std::stable_sort(bodies.begin(), bodies.end(),
                     [&](const auto* a, const auto* b) { return triangles(a) > triangles(b); });
    std::vector<std::shared_ptr<const View>> views{view};
    for (std::size_t i = 0; i < std::min(count, bodies.size()); ++i) {
        views.push_back(std::make_shared<View>(
            View{view->name + ", " + bodies[i]->name, view->scene, lookAt(boundsOf(scene, *bodies[i]), view->camera)}));
    }
    return views;
}

} // namespace nacre::bench
