// Pictures made to be shown: which decoder reads them, and PNG, JPEG and Radiance files written by stb_image_write.
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stb/stb_image_write.h>
#include <string_view>

namespace nacre {
namespace {

/// Most pixels of an 8-bit image (256 MiB as RGBA): a small file can unfold to so many.
constexpr std::uint64_t maxBytePixels = std::uint64_t{1} << 26;
/// Its sizes have 16 bits.
constexpr std::uint32_t maxJpegSide = 65535;

using Path = std::filesystem::path;

void appendBytes(void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
}

/// Throws unless the values fill a picture that the encoder can count the bytes of.
void requireWritable(const Path& file, const char* kind, const Image& image) {
    const std::uint64_t size = std::uint64_t{image.width} * image.height * image.channels.size();
    if (size == 0 || size != image.values.size() ||
        size > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
        throw FileError(file.string() + ": cannot write a " + kind + " of " + std::to_string(image.width) + " x " +
                        std::to_string(image.height) + " pixels and " + std::to_string(image.channels.size()) +
                        " channels from " + std::to_string(image.values.size()) + " values");
    }
}

std::vector<std::uint8_t> toBytes(const Image& image) {
    std::vector<std::uint8_t> bytes(image.values.size());
    const Image shown = toEncoding(image, Encoding::Srgb);
    std::ranges::transform(shown.values, bytes.begin(), [](float value) {
        return static_cast<std::uint8_t>(std::lround(value > 0 ? std::min(value, 1.0f) * 255 : 0.0f));
    });
    return bytes;
}

struct Format {
    bool (*matches)(std::span<const std::uint8_t> bytes);
    IntegerImage (*decode)(std::span<const std::uint8_t> bytes, const std::string& name);
};

/// How the files of formats begin that are not read as pictures of whole numbers.
struct UnreadFormat {
    std::string_view name;
    std::size_t offset;
    std::string_view signature;
};

constexpr UnreadFormat unreadFormats[] = {{"KTX", 0, "\xabKTX 11\xbb"},
                                          {"KTX2", 0, "\xabKTX 20\xbb"},
                                          {"DDS", 0, "DDS "},
                                          {"GIF", 0, "GIF8"},
                                          {"TIFF", 0, std::string_view("II*\0", 4)},
                                          {"TIFF", 0, std::string_view("MM\0*", 4)},
                                          {"Photoshop", 0, "8BPS"},
                                          {"AVIF or HEIF", 4, "ftyp"},
                                          {"JPEG XL", 4, "JXL "},
                                          {"OpenEXR", 0, "\x76\x2f\x31\x01"},
                                          {"Radiance", 0, "#?R"}};

void requireReadFormat(std::span<const std::uint8_t> bytes, const std::string& name) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const UnreadFormat& format : unreadFormats) {
        if (text.size() > format.offset && text.substr(format.offset).starts_with(format.signature)) {
            throw UnreadPicture(name + ": is a " + std::string(format.name) + " image, which is not read here");
        }
    }
}

IntegerImage decodeInteger(std::span<const std::uint8_t> bytes, const std::string& name) {
    constexpr Format formats[] = {{isPng, decodePng}, {isJpeg, decodeJpeg}, {isWebp, decodeWebp}};
    for (const Format& format : formats) {
        if (format.matches(bytes)) {
            return format.decode(bytes, name);
        }
    }
    requireReadFormat(bytes, name);
    return decodeBitmap(bytes, name);
}

/// Grey fills red, green and blue; alpha is 255 where there is none.
std::vector<std::uint8_t> toRgba(const std::vector<std::uint8_t>& samples, std::size_t channels) {
    const std::size_t pixels = samples.size() / channels;
    const bool isColor = channels >= 3;
    const bool hasAlpha = channels % 2 == 0;
    std::vector<std::uint8_t> rgba(pixels * 4, 255);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const std::uint8_t* from = &samples[pixel * channels];
        std::uint8_t* to = &rgba[pixel * 4];
        for (std::size_t i = 0; i < 3; ++i) {
            to[i] = from[isColor ? i : 0];
        }
        if (hasAlpha) {
            to[3] = from[channels - 1];
        }
    }
    return rgba;
}

template <typename Sample> void fill(std::vector<float>& values, const std::vector<Sample>& samples) {
    std::ranges::transform(samples, values.begin(), [](Sample sample) {
        return static_cast<float>(sample) / static_cast<float>(std::numeric_limits<Sample>::max());
    });
}

} // namespace

void writePng(const Path& file, const Image& image) {
    const std::size_t channels = image.channels.size();
    if (channels != 1 && channels != 3 && channels != 4) {
        throw FileError(file.string() + ": a PNG has 1, 3 or 4 channels, not " + std::to_string(channels));
    }
    requireWritable(file, "PNG", image);
    std::vector<std::uint8_t> encoded;
    const int stride = static_cast<int>(image.width * channels);
    if (stbi_write_png_to_func(appendBytes, &encoded, static_cast<int>(image.width), static_cast<int>(image.height),
                               static_cast<int>(channels), toBytes(image).data(), stride) == 0) {
        throw FileError(file.string() + ": the PNG encoder ran out of memory");
    }
    writeFileAtomically(file, encoded);
}

void writeJpeg(const Path& file, const Image& image, int quality) {
    if (image.channels.size() != 3) {
        throw FileError(file.string() + ": a JPEG has 3 channels, not " + std::to_string(image.channels.size()));
    }
    requireWritable(file, "JPEG", image);
    if (std::max(image.width, image.height) > maxJpegSide) {
        throw FileError(file.string() + ": a JPEG's sides are at most " + std::to_string(maxJpegSide) +
                        " pixels long, not " + std::to_string(std::max(image.width, image.height)));
    }
    std::vector<std::uint8_t> encoded;
    if (stbi_write_jpg_to_func(appendBytes, &encoded, static_cast<int>(image.width), static_cast<int>(image.height), 3,
                               toBytes(image).data(), quality) == 0) {
        throw FileError(file.string() + ": the JPEG encoder refused the picture");
    }
    writeFileAtomically(file, encoded);
}

void writeHdr(const Path& file, const Image& image) {
    if (image.channels.size() != 3) {
        throw FileError(file.string() + ": a Radiance image has 3 channels, not " +
                        std::to_string(image.channels.size()));
    }
    requireWritable(file, "Radiance image", image);
    const Image linear = toEncoding(image, Encoding::Linear);
    std::vector<std::uint8_t> encoded;
    if (stbi_write_hdr_to_func(appendBytes, &encoded, static_cast<int>(image.width), static_cast<int>(image.height), 3,
                               linear.values.data()) == 0) {
        throw FileError(file.string() + ": the Radiance encoder ran out of memory");
    }
    writeFileAtomically(file, encoded);
}

void requireShowable(const std::string& name, std::uint64_t width, std::uint64_t height) {
    if (width == 0 || height == 0 || std::max(width, height) > maxImageSide || width * height > maxBytePixels) {
        throw FileError(name + ": image of " + std::to_string(width) + " x " + std::to_string(height) +
                        " pixels cannot be read, 1 to " + std::to_string(maxImageSide) + " a side and at most " +
                        std::to_string(maxBytePixels) + " in all");
    }
}

ByteImage decodeBytes(std::span<const std::uint8_t> bytes, const std::string& name) {
    IntegerImage image = decodeInteger(bytes, name);
    if (!image.words.empty()) {
        image.bytes.resize(image.words.size());
        std::ranges::transform(image.words, image.bytes.begin(),
                               [](std::uint16_t word) { return static_cast<std::uint8_t>((word + 128) / 257); });
    }
    return {image.width, image.height,
            image.channels == 4 ? std::move(image.bytes) : toRgba(image.bytes, image.channels)};
}

Image decodeShown(std::span<const std::uint8_t> bytes, const std::string& name) {
    const IntegerImage integers = decodeInteger(bytes, name);
    requireReadable(name, integers.width, integers.height, integers.channels);
    const std::vector<std::string> channels[] = {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    Image image = makeImage(integers.width, integers.height, channels[integers.channels - 1], Encoding::Srgb);
    if (integers.words.empty()) {
        fill(image.values, integers.bytes);
    } else {
        fill(image.values, integers.words);
    }
    return image;
}

} // namespace nacre
