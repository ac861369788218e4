#include "trace/texture_lookup.hpp"

#include "scene/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nacre::trace {
namespace {

std::array<float, 256> makeDecodeTable(bool srgb) {
    std::array<float, 256> table{};
    std::ranges::transform(scene::linearValues(srgb), table.begin(),
                           [](double value) { return static_cast<float>(value); });
    return table;
}

std::size_t texelIndex(std::int64_t index, std::uint32_t size, scene::Wrap wrap) {
    const std::int64_t count = size;
    if (wrap == scene::Wrap::Repeat) {
        index = ((index % count) + count) % count;
    } else if (wrap == scene::Wrap::Mirror) {
        index = ((index % (2 * count)) + 2 * count) % (2 * count);
        index = std::min(index, 2 * count - 1 - index);
    }
    return static_cast<std::size_t>(std::clamp<std::int64_t>(index, 0, count - 1));
}

/// The same place nearer to 0: far from it a float has no fraction left, and no index either.
float nearZero(float coordinate, scene::Wrap wrap) {
    switch (wrap) {
    case scene::Wrap::Repeat:
        return coordinate - std::floor(coordinate);
    case scene::Wrap::Mirror:
        return coordinate - 2 * std::floor(coordinate / 2);
    case scene::Wrap::Clamp:
        break;
    }
    return glm::clamp(coordinate, 0.0f, 1.0f);
}

} // namespace

glm::vec4 sampleTexture(const scene::Texture& texture, const glm::vec2& uv) {
    static const std::array<float, 256> srgbTable = makeDecodeTable(true);
    static const std::array<float, 256> linearTable = makeDecodeTable(false);
    const std::array<float, 256>& colorTable = texture.srgb ? srgbTable : linearTable;
    const glm::vec2 place(nearZero(uv.x, texture.wrapU), nearZero(uv.y, texture.wrapV));
    if (!std::isfinite(place.x + place.y)) {
        return glm::vec4(0);
    }
    float x = place.x * static_cast<float>(texture.width) - 0.5f;
    float y = place.y * static_cast<float>(texture.height) - 0.5f;
    if (texture.nearest) {
        x = std::round(x);
        y = std::round(y);
    }
    const float floorX = std::floor(x);
    const float floorY = std::floor(y);
    glm::vec4 sum(0);
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const std::size_t column = texelIndex(static_cast<std::int64_t>(floorX) + i, texture.width, texture.wrapU);
            const std::size_t row = texelIndex(static_cast<std::int64_t>(floorY) + j, texture.height, texture.wrapV);
            const std::uint8_t* texel = &texture.pixels[(row * texture.width + column) * 4];
            const float weight = (i == 0 ? 1 - (x - floorX) : x - floorX) * (j == 0 ? 1 - (y - floorY) : y - floorY);
            sum += weight *
                   glm::vec4(colorTable[texel[0]], colorTable[texel[1]], colorTable[texel[2]], linearTable[texel[3]]);
        }
    }
    return sum;
}

} // namespace nacre::trace
