#include "scene/gallery/paint.hpp"

#include "scene/gallery/portable_math.hpp"

namespace nacre::scene::gallery {

namespace {

/// IEC 61966-2-1, 8 bit.
std::uint8_t encodeSrgb(float linear) {
    const float x = glm::clamp(linear, 0.f, 1.f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * exponential(logarithm(x) / 2.4f) - 0.055f;
    return std::uint8_t(255 * encoded + 0.5f);
}

} // namespace

Texture paint(const char* name, std::uint32_t size, const std::function<glm::vec3(const glm::vec2& uv)>& color) {
    Texture texture;
    texture.name = name;
    texture.width = texture.height = size;
    texture.srgb = true;
    texture.wrapU = texture.wrapV = Wrap::Clamp;
    texture.pixels.reserve(std::size_t(4) * size * size);
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x) {
            const glm::vec3 linear = color(glm::vec2(float(x) + 0.5f, float(y) + 0.5f) / float(size));
            for (int c = 0; c < 3; ++c)
                texture.pixels.push_back(encodeSrgb(linear[c]));
            texture.pixels.push_back(255);
        }
    return texture;
}

} // namespace nacre::scene::gallery
