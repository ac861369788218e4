// WebP, by libwebp.
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <webp/decode.h>

namespace nacre {

bool isWebp(std::span<const std::uint8_t> bytes) {
    return WebPGetInfo(bytes.data(), bytes.size(), nullptr, nullptr) != 0;
}

IntegerImage decodeWebp(std::span<const std::uint8_t> bytes, const std::string& name) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK || features.has_animation != 0) {
        throw FileError(name + ": the WebP image " +
                        (features.has_animation != 0 ? "is an animation, which is not read" : "cannot be decoded"));
    }
    requireShowable(name, static_cast<std::uint64_t>(features.width), static_cast<std::uint64_t>(features.height));
    const bool hasAlpha = features.has_alpha != 0;
    IntegerImage image{.width = static_cast<std::uint32_t>(features.width),
                       .height = static_cast<std::uint32_t>(features.height),
                       .channels = hasAlpha ? 4u : 3u};
    image.bytes.resize(image.channels * image.width * image.height);
    const int stride = static_cast<int>(image.channels * image.width);
    const auto decode = hasAlpha ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
    if (decode(bytes.data(), bytes.size(), image.bytes.data(), image.bytes.size(), stride) == nullptr) {
        throw FileError(name + ": the WebP image cannot be decoded");
    }
    return image;
}

} // namespace nacre
