#include "scene/texture.hpp"

#include "image/image_file.hpp"

#include <cmath>

namespace nacre::scene {

Texture decodeTexture(std::span<const std::uint8_t> bytes, const std::string& name, bool srgb) {
    ByteImage image = decodeBytes(bytes, name);
    Texture texture;
    texture.name = name;
    texture.width = image.width;
    texture.height = image.height;
    texture.srgb = srgb;
    texture.pixels = std::move(image.rgba);
    return texture;
}

Texture readTexture(const std::filesystem::path& file, bool srgb) {
    return decodeTexture(readFile(file), file.string(), srgb);
}

std::array<double, 256> linearValues(bool srgb) {
    std::array<double, 256> result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double value = static_cast<double>(i) / 255;
        const double linear = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        result[i] = srgb ? linear : value;
    }
    return result;
}

} // namespace nacre::scene
