#include "trace/texture_lookup.hpp"

#include <array>
#include <cmath>

namespace nacre::trace {
namespace {

std::array<float, 256> makeDecodeTable(bool srgb) {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double value = static_cast<double>(i) / 255;
        // IEC 61966-2-1.
        const double linear = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        table[i] = static_cast<float>(srgb ? linear : value);
    }
    return table;
}

std::size_t texelIndex(std::int64_t index, std::uint32_t size, bool repeat) {
    const std::int64_t count = size;
    return static_cast<std::size_t>(repeat ? ((index % count) + count) % count
                                           : std::min(std::max<std::int64_t>(index, 0), count - 1));
}

} // namespace

glm::vec4 sampleTexture(const scene::Texture& texture, const glm::vec2& uv) {
    static const std::array<float, 256> srgbTable = makeDecodeTable(true);
    static const std::array<float, 256> linearTable = makeDecodeTable(false);
    const std::array<float, 256>& colorTable = texture.srgb ? srgbTable : linearTable;
    // Far from 0 a float has no fraction left, and no index either.
    const glm::vec2 place = texture.repeat ? uv - glm::floor(uv) : glm::clamp(uv, glm::vec2(0), glm::vec2(1));
    if (!std::isfinite(place.x + place.y)) {
        return glm::vec4(0);
    }
    const float x = place.x * static_cast<float>(texture.width) - 0.5f;
    const float y = place.y * static_cast<float>(texture.height) - 0.5f;
    const float floorX = std::floor(x);
    const float floorY = std::floor(y);
    glm::vec4 sum(0);
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const std::size_t column = texelIndex(static_cast<std::int64_t>(floorX) + i, texture.width, texture.repeat);
            const std::size_t row = texelIndex(static_cast<std::int64_t>(floorY) + j, texture.height, texture.repeat);
            const std::uint8_t* texel = &texture.pixels[(row * texture.width + column) * 4];
            const float weight = (i == 0 ? 1 - (x - floorX) : x - floorX) * (j == 0 ? 1 - (y - floorY) : y - floorY);
            sum += weight *
                   glm::vec4(colorTable[texel[0]], colorTable[texel[1]], colorTable[texel[2]], linearTable[texel[3]]);
        }
    }
    return sum;
}

} // namespace nacre::trace
