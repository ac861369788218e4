#include "scene/gltf/gltf_scale_texture.hpp"

#include "scene/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nacre::scene {
namespace {

/// Scales that are closer than this are one.
constexpr double sameScale = 1.01;

/// By a texel's value: a third of its channel's part of the mean.
using Parts = std::array<double, 256>;

Parts partsOf(const GltfMedium& medium, int channel, double factor, bool srgb) {
    const double own = denseMeanFreePath(medium, channel, static_cast<double>(medium.multiscatterColor[channel]));
    Parts parts = linearValues(srgb);
    for (double& part : parts) {
        part = denseMeanFreePath(medium, channel, factor * part) / own / 3;
    }
    return parts;
}

} // namespace

std::optional<ScaleTexture> makeScaleTexture(const GltfMedium& medium, const glm::vec3& factor, const Texture& colors) {
    std::array<Parts, 3> parts{};
    for (int channel = 0; channel < 3; ++channel) {
        parts[static_cast<std::size_t>(channel)] =
            partsOf(medium, channel, static_cast<double>(factor[channel]), colors.srgb);
    }
    const auto scaleAt = [&](std::size_t texel) {
        const std::uint8_t* rgba = &colors.pixels[texel * 4];
        return std::clamp(parts[0][rgba[0]] + parts[1][rgba[1]] + parts[2][rgba[2]], double{leastScale},
                          double{largestScale});
    };
    const std::size_t count = colors.pixels.size() / 4;
    double least = largestScale;
    double largest = leastScale;
    for (std::size_t texel = 0; texel < count; ++texel) {
        const double scale = scaleAt(texel);
        least = std::min(least, scale);
        largest = std::max(largest, scale);
    }
    if (largest <= sameScale * least) {
        return std::nullopt;
    }
    ScaleTexture result{.texture = colors, .largest = static_cast<float>(largest)};
    result.texture.name = colors.name + ", lengths";
    result.texture.srgb = false;
    for (std::size_t texel = 0; texel < count; ++texel) {
        const double share = std::max(std::round(255 * scaleAt(texel) / largest), 1.0);
        std::fill_n(&result.texture.pixels[texel * 4], 3, static_cast<std::uint8_t>(share));
        result.texture.pixels[texel * 4 + 3] = 255;
    }
    return result;
}

} // namespace nacre::scene
