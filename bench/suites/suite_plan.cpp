#include "bench/suites/suite_plan.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace nacre::bench {
namespace {

double targetDistance(const scene::Camera& camera) {
    return static_cast<double>(glm::length(camera.target - camera.position));
}

// The thesis's 1 / tan(55° / 2), times 2: NacreBaselineSettings::thesisStrength says how it moves taps.
constexpr double thesisStep = 2 * 1.92;

} // namespace

std::vector<std::string> notesOf(const Plan& plan) {
    std::set<std::string> notes;
    for (const Series& series : plan.series) {
        for (const Configuration& configuration : series.configurations) {
            notes.insert(configuration.view->scene->notes.begin(), configuration.view->scene->notes.end());
        }
    }
    return {notes.begin(), notes.end()};
}

double pixelsPerMillimeter(const View& view, const Size& size) {
    const scene::Camera& camera = view.camera;
    const double height = camera.projection == scene::ProjectionKind::Perspective
                              ? 2 * targetDistance(camera) * std::tan(camera.verticalFieldOfView / 2.0)
                              : static_cast<double>(camera.orthographicHeight);
    return size.height / (1000 * height * view.scene->metersPerUnit);
}

float thesisStrength(const View& view, const Size& size, std::uint32_t radius) {
    const double pixels = pixelsPerMillimeter(view, size);
    return static_cast<float>(pixels * targetDistance(view.camera) * radius / thesisStep);
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
