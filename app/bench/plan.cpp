#include "app/bench/plan.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace nacre::bench {

double pixelsPerMillimeter(const View& view, const Size& size) {
    const scene::Camera& camera = view.camera;
    const double distance = glm::length(camera.target - camera.position);
    const double height = camera.projection == scene::ProjectionKind::Perspective
                              ? 2 * distance * std::tan(camera.verticalFieldOfView / 2.0)
                              : static_cast<double>(camera.orthographicHeight);
    return size.height / (1000 * height * view.scene->metersPerUnit);
}

double footprint(const View& view, const Size& size, const std::vector<Material>& materials) {
    double widest = 0;
    for (const Material& material : materials) {
        const auto profile = makeProfile(material);
        for (int channel = 0; channel < 3; ++channel) {
            widest = std::max(widest, profile->rmsRadius(channel));
        }
    }
    return widest * pixelsPerMillimeter(view, size);
}

} // namespace nacre::bench
