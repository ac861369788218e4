#include "scene/sky.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::scene {
namespace {

constexpr std::uint32_t skyHeight = 128; ///< px; the gradient is smooth

float smoothStep(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

} // namespace

nacre::Image makeSky(const Environment& environment) {
    nacre::Image image{2 * skyHeight, skyHeight, {"R", "G", "B", "A"}, {}};
    for (std::uint32_t row = 0; row < image.height; ++row) {
        const float elevation = std::cos(std::numbers::pi_v<float> * (static_cast<float>(row) + 0.5f) / skyHeight);
        const glm::vec3 above = glm::mix(environment.horizon, environment.zenith, std::sqrt(std::max(elevation, 0.0f)));
        const glm::vec3 color = glm::mix(environment.ground, above, smoothStep(-0.15f, 0.05f, elevation));
        for (std::uint32_t column = 0; column < image.width; ++column) {
            image.values.insert(image.values.end(), {color.r, color.g, color.b, 1.0f});
        }
    }
    return image;
}

} // namespace nacre::scene
