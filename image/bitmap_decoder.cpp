// BMP and TGA, by stb_image, which is built with these alone (stb_image.c). Nobody fuzzes it for the damaged files that
// it does not expect, so that it runs where a crash is a sentence.
#include "core/files/isolated_process.hpp"
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <stb/stb_image.h>

namespace nacre {
namespace {

/// A run of TGA has up to 128 pixels. stb_image makes up what a file lacks.
constexpr std::uint64_t mostBitmapPixelsPerByte = 128;

/// What comes across before the samples.
struct BitmapSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t channels = 0;
};

} // namespace

IntegerImage decodeBitmapHere(std::span<const std::uint8_t> bytes, const std::string& name) {
    int width = 0;
    int height = 0;
    int channels = 0;
    const int count = static_cast<int>(bytes.size());
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
        stbi_info_from_memory(bytes.data(), count, &width, &height, &channels) == 0 || width <= 0 || height == 0 ||
        height == std::numeric_limits<int>::min()) {
        throw FileError(name + ": is not a PNG, JPEG, WebP, BMP or TGA image that can be read");
    }
    height = std::abs(height); // a BMP whose first row is its uppermost has a negative one
    requireShowable(name, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
    if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) >
        mostBitmapPixelsPerByte * bytes.size()) {
        throw FileError(name + ": the BMP or TGA image is cut off: " + std::to_string(bytes.size()) +
                        " bytes cannot hold " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
    }
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> samples(
        stbi_load_from_memory(bytes.data(), count, &width, &height, &channels, 0), stbi_image_free);
    if (!samples) {
        throw FileError(name + ": the BMP or TGA image cannot be decoded: " + stbi_failure_reason());
    }
    IntegerImage image{.width = static_cast<std::uint32_t>(width),
                       .height = static_cast<std::uint32_t>(height),
                       .channels = static_cast<std::size_t>(channels)};
    image.bytes.assign(samples.get(), samples.get() + image.channels * image.width * image.height);
    return image;
}

IntegerImage decodeBitmap(std::span<const std::uint8_t> bytes, const std::string& name) {
    std::vector<std::uint8_t> result = runIsolated(name, limitsFor(bytes.size()), [&] {
        IntegerImage image = decodeBitmapHere(bytes, name);
        const BitmapSize size{image.width, image.height, static_cast<std::uint32_t>(image.channels)};
        const auto* first = reinterpret_cast<const std::uint8_t*>(&size);
        image.bytes.insert(image.bytes.end(), first, first + sizeof(size));
        return std::move(image.bytes);
    });
    BitmapSize size;
    if (result.size() >= sizeof(size)) {
        std::memcpy(&size, result.data() + result.size() - sizeof(size), sizeof(size));
        result.resize(result.size() - sizeof(size));
    }
    if (size.channels < 1 || size.channels > 4 || result.empty() ||
        result.size() != std::uint64_t{size.width} * size.height * size.channels) {
        throw FileError(name + ": is damaged: reading it fails");
    }
    return {.width = size.width, .height = size.height, .channels = size.channels, .bytes = std::move(result)};
}

} // namespace nacre
