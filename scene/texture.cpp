#include "scene/texture.hpp"

#include "image/image_file.hpp"

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

} // namespace nacre::scene
