#include "view/loop/sample_place.hpp"

#include <cmath>

namespace nacre::view {
namespace {

/// Element `index` of the Halton sequence of `base`, [0, 1).
float halton(std::uint32_t index, std::uint32_t base) {
    float result = 0;
    for (float digit = 1.0f / static_cast<float>(base); index > 0; index /= base, digit /= static_cast<float>(base)) {
        result += digit * static_cast<float>(index % base);
    }
    return result;
}

} // namespace

glm::vec2 jitterOf(std::uint32_t index) {
    return index == 0 ? glm::vec2(0) : glm::vec2(halton(index, 2) - 0.5f, halton(index, 3) - 0.5f);
}

float pixelsPerMillimeter(const scene::Camera& camera, std::uint32_t height, float metersPerUnit) {
    const float millimeters = 1000 * metersPerUnit;
    return camera.projection == scene::ProjectionKind::Orthographic
               ? -static_cast<float>(height) / (camera.orthographicHeight * millimeters)
               : static_cast<float>(height) / (2 * std::tan(camera.verticalFieldOfView / 2) * millimeters);
}

float pixelWidth(const scene::Camera& camera, std::uint32_t height) {
    return camera.projection == scene::ProjectionKind::Orthographic
               ? -camera.orthographicHeight / static_cast<float>(height)
               : 2 * std::tan(camera.verticalFieldOfView / 2) / static_cast<float>(height);
}

} // namespace nacre::view
