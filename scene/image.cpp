#include "scene/image.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

namespace nacre::scene {
namespace {

/// Most pixels of a texture (512 MiB as RGBA).
constexpr std::uint64_t maxTexturePixels = std::uint64_t{1} << 27;
/// Its sizes have 16 bits.
constexpr std::uint32_t maxJpegSide = 65535;

void appendBytes(void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
}

// Throws unless the pixels fill a picture that the encoder can count the bytes of.
void checkPixels(const std::filesystem::path& file, const char* kind, std::uint32_t width, std::uint32_t height,
                 int channels, std::span<const std::uint8_t> pixels) {
    const std::uint64_t size = std::uint64_t{width} * height * static_cast<std::uint64_t>(channels);
    if (size == 0 || size != pixels.size() || size > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
        throw SceneError(file.string() + ": cannot write a " + kind + " of " + std::to_string(width) + " x " +
                         std::to_string(height) + " pixels from " + std::to_string(pixels.size()) + " bytes");
    }
}

} // namespace

void writePng(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height, int channels,
              std::span<const std::uint8_t> pixels) {
    if (channels != 3 && channels != 4) {
        throw SceneError(file.string() + ": a PNG has 3 or 4 channels, not " + std::to_string(channels));
    }
    checkPixels(file, "PNG", width, height, channels, pixels);
    std::vector<std::uint8_t> bytes;
    const int stride = static_cast<int>(width) * channels;
    if (stbi_write_png_to_func(appendBytes, &bytes, static_cast<int>(width), static_cast<int>(height), channels,
                               pixels.data(), stride) == 0) {
        throw SceneError(file.string() + ": the PNG encoder ran out of memory");
    }
    writeFileAtomically(file, bytes);
}

void writeJpeg(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
               std::span<const std::uint8_t> pixels, int quality) {
    constexpr int channels = 3;
    checkPixels(file, "JPEG", width, height, channels, pixels);
    if (std::max(width, height) > maxJpegSide) {
        throw SceneError(file.string() + ": a JPEG's sides are at most " + std::to_string(maxJpegSide) +
                         " pixels long, not " + std::to_string(std::max(width, height)));
    }
    std::vector<std::uint8_t> bytes;
    if (stbi_write_jpg_to_func(appendBytes, &bytes, static_cast<int>(width), static_cast<int>(height), channels,
                               pixels.data(), quality) == 0) {
        throw SceneError(file.string() + ": the JPEG encoder refused the picture");
    }
    writeFileAtomically(file, bytes);
}

Texture decodeTexture(std::span<const std::uint8_t> bytes, const std::string& name, bool srgb) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw SceneError(name + ": image is larger than 2 GiB");
    }
    int width = 0;
    int height = 0;
    int channels = 0;
    const int size = static_cast<int>(bytes.size());
    if (stbi_is_hdr_from_memory(bytes.data(), size) != 0 || // of which stb_image would make 8 bits
        stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0 || width <= 0 || height <= 0) {
        throw SceneError(name + ": is not a readable PNG, JPEG, BMP, TGA or PSD image of at most " +
                         std::to_string(maxImageSide) + " pixels a side");
    }
    const std::uint64_t pixelCount = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (static_cast<std::uint32_t>(std::max(width, height)) > maxImageSide || pixelCount > maxTexturePixels) {
        throw SceneError(name + ": image of " + std::to_string(width) + " x " + std::to_string(height) +
                         " pixels is too large, at most " + std::to_string(maxImageSide) + " a side and " +
                         std::to_string(maxTexturePixels) + " in all");
    }
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> decoded(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, STBI_rgb_alpha), stbi_image_free);
    if (!decoded) {
        throw SceneError(name + ": image cannot be decoded: " + stbi_failure_reason());
    }
    Texture texture;
    texture.name = name;
    texture.width = static_cast<std::uint32_t>(width);
    texture.height = static_cast<std::uint32_t>(height);
    texture.srgb = srgb;
    texture.pixels.assign(decoded.get(), decoded.get() + pixelCount * 4);
    return texture;
}

Texture readTexture(const std::filesystem::path& file, bool srgb) {
    return decodeTexture(readFile(file), file.string(), srgb);
}

} // namespace nacre::scene
