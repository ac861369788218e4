#include "bench/accuracy/thin_parts.hpp"

#include "nacre/material.hpp"
#include "trace/view.hpp"

#include <glm/geometric.hpp>

namespace nacre::bench {
namespace {

/// mm, of each material
std::vector<double> thinThicknesses(const scene::Scene& scene) {
    std::vector<double> result;
    for (const Material& material : scene.materials) {
        result.push_back(makeProfile(material)->quantileRadius(1 - thinTransmittance));
    }
    return result;
}

} // namespace

Mask thinParts(const AccuracyView& view, const Size& size) {
    const trace::Geometry geometry(*view.scene);
    const trace::View camera(view.camera, size.width, size.height);
    const std::vector<double> thin = thinThicknesses(*view.scene);
    Mask mask(std::size_t{size.width} * size.height);
    for (std::size_t pixel = 0; pixel < mask.size(); ++pixel) {
        const std::size_t column = pixel % size.width;
        const std::size_t row = pixel / size.width;
        const trace::Ray ray = camera.ray(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        const auto hit = geometry.visible(ray);
        if (!hit) {
            continue;
        }
        const trace::SurfacePoint point = geometry.surfaceAt(*hit);
        if (point.material == scene::none) {
            continue;
        }
        const glm::vec3 inwards = glm::dot(ray.direction, point.normal) < 0 ? -point.normal : point.normal;
        const auto exit = geometry.closest({geometry.movedOff(point.position, inwards), inwards});
        const double millimetres = 1000 * view.scene->metersPerUnit;
        mask[pixel] = exit && exit->distance * millimetres < thin[point.material] ? 1 : 0;
    }
    return mask;
}

} // namespace nacre::bench
