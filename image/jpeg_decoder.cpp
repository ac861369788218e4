// JPEG, by libjpeg-turbo.
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <cstring>
#include <memory>
#include <string_view>
#include <turbojpeg.h>

namespace nacre {
namespace {

struct Destroy {
    void operator()(void* decoder) const { tjDestroy(decoder); }
};
using Decoder = std::unique_ptr<void, Destroy>;

[[noreturn]] void fail(const Decoder& decoder, const std::string& name) {
    throw FileError(name + ": the JPEG image cannot be decoded: " + tjGetErrorStr2(decoder.get()));
}

/// Whether a file has the marker of Adobe's programs (APP14) before its first scan.
bool hasAdobeMarker(std::span<const std::uint8_t> bytes) {
    constexpr std::uint8_t app14 = 0xee;
    constexpr std::uint8_t startOfScan = 0xda;
    constexpr std::string_view name = "Adobe";
    for (std::size_t i = 2; i + 4 < bytes.size() && bytes[i] == 0xff && bytes[i + 1] != startOfScan;) {
        if (bytes[i + 1] == 0xff) { // filling
            ++i;
            continue;
        }
        const auto content = bytes.subspan(i + 4);
        if (bytes[i + 1] == app14 && content.size() >= name.size() &&
            std::memcmp(content.data(), name.data(), name.size()) == 0) {
            return true;
        }
        i += 2 + (std::size_t{bytes[i + 2]} << 8 | bytes[i + 3]);
    }
    return false;
}

/// Of shares of ink, or of what ink leaves, which Adobe's programs store.
std::vector<std::uint8_t> rgbOf(const std::vector<std::uint8_t>& cmyk, bool isLeft) {
    const auto left = [&](std::size_t i) { return isLeft ? cmyk[i] : 255 - cmyk[i]; };
    std::vector<std::uint8_t> rgb;
    rgb.reserve(cmyk.size() / 4 * 3);
    for (std::size_t i = 0; i < cmyk.size(); i += 4) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            rgb.push_back(static_cast<std::uint8_t>(left(i + channel) * left(i + 3) / 255));
        }
    }
    return rgb;
}

struct Layout {
    std::size_t channels;
    int format;
};

Layout layoutOf(int colorSpace) {
    switch (colorSpace) {
    case TJCS_GRAY:
        return {1, TJPF_GRAY};
    case TJCS_CMYK:
    case TJCS_YCCK:
        return {4, TJPF_CMYK};
    default:
        return {3, TJPF_RGB};
    }
}

} // namespace

bool isJpeg(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

IntegerImage decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name) {
    const Decoder decoder(tjInitDecompress());
    if (!decoder) {
        throw std::bad_alloc();
    }
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colorSpace = 0;
    const auto size = static_cast<unsigned long>(bytes.size());
    if (tjDecompressHeader3(decoder.get(), bytes.data(), size, &width, &height, &subsampling, &colorSpace) != 0) {
        fail(decoder, name);
    }
    requireShowable(name, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
    const Layout layout = layoutOf(colorSpace);
    IntegerImage image{.width = static_cast<std::uint32_t>(width),
                       .height = static_cast<std::uint32_t>(height),
                       .channels = layout.channels};
    image.bytes.resize(image.channels * image.width * image.height);
    // A warning leaves the picture whole, but for one about a file that is cut off. Scans are limited: a small
    // progressive file could have so many that decoding takes minutes.
    if (tjDecompress2(decoder.get(), bytes.data(), size, image.bytes.data(), width, 0, height, layout.format,
                      TJFLAG_LIMITSCANS) != 0 &&
        (tjGetErrorCode(decoder.get()) == TJERR_FATAL ||
         std::strstr(tjGetErrorStr2(decoder.get()), "Premature end") != nullptr)) {
        fail(decoder, name);
    }
    if (layout.format == TJPF_CMYK) {
        image.bytes = rgbOf(image.bytes, hasAdobeMarker(bytes));
        image.channels = 3;
    }
    return image;
}

} // namespace nacre
