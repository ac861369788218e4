// BMP and TGA, by stb_image, which is built with these and the header of Radiance files alone (stb_image.c).
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <limits>
#include <memory>
#include <stb/stb_image.h>

namespace nacre {

IntegerImage decodeBitmap(std::span<const std::uint8_t> bytes, const std::string& name) {
    int width = 0;
    int height = 0;
    int channels = 0;
    const int count = static_cast<int>(bytes.size());
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
        stbi_is_hdr_from_memory(bytes.data(), count) != 0 || // of which stb_image would make 8 bits
        stbi_info_from_memory(bytes.data(), count, &width, &height, &channels) == 0 || width <= 0 || height <= 0) {
        throw FileError(name + ": is not a PNG, JPEG, WebP, BMP or TGA image that can be read");
    }
    requireShowable(name, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
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

} // namespace nacre
