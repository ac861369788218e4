// PNG, JPEG and what else is made to be shown, by stb_image; the Radiance writer is stb's, too.
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

namespace nacre {
namespace {

/// Most pixels of an 8-bit image (512 MiB as RGBA).
constexpr std::uint64_t maxBytePixels = std::uint64_t{1} << 27;
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

struct Size {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::uint64_t pixels() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

/// Throws unless it is an image that stb_image reads, of a size that is read.
Size findSize(std::span<const std::uint8_t> bytes, const std::string& name) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw FileError(name + ": image is larger than 2 GiB");
    }
    Size size;
    const int count = static_cast<int>(bytes.size());
    if (stbi_is_hdr_from_memory(bytes.data(), count) != 0 || // of which stb_image would make 8 bits
        stbi_info_from_memory(bytes.data(), count, &size.width, &size.height, &size.channels) == 0 || size.width <= 0 ||
        size.height <= 0) {
        throw FileError(name + ": is not a readable PNG, JPEG, BMP, TGA or PSD image of at most " +
                        std::to_string(maxImageSide) + " pixels a side");
    }
    if (static_cast<std::uint32_t>(std::max(size.width, size.height)) > maxImageSide || size.pixels() > maxBytePixels) {
        throw FileError(name + ": image of " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                        " pixels is too large, at most " + std::to_string(maxImageSide) + " a side and " +
                        std::to_string(maxBytePixels) + " in all");
    }
    return size;
}

template <typename Sample> using Decoder = Sample* (*)(const stbi_uc*, int, int*, int*, int*, int);

/// The samples as stb_image decodes them, `channels` a pixel.
template <typename Sample>
std::unique_ptr<Sample, decltype(&stbi_image_free)> decode(Decoder<Sample> decoder, std::span<const std::uint8_t> bytes,
                                                           const std::string& name, Size& size, int channels) {
    std::unique_ptr<Sample, decltype(&stbi_image_free)> samples(
        decoder(bytes.data(), static_cast<int>(bytes.size()), &size.width, &size.height, &size.channels, channels),
        stbi_image_free);
    if (!samples) {
        throw FileError(name + ": image cannot be decoded: " + stbi_failure_reason());
    }
    return samples;
}

template <typename Sample> void fill(std::vector<float>& values, const Sample* samples) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<float>(samples[i]) / static_cast<float>(std::numeric_limits<Sample>::max());
    }
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

ByteImage decodeBytes(std::span<const std::uint8_t> bytes, const std::string& name) {
    Size size = findSize(bytes, name);
    const auto samples = decode<stbi_uc>(stbi_load_from_memory, bytes, name, size, STBI_rgb_alpha);
    return {static_cast<std::uint32_t>(size.width),
            static_cast<std::uint32_t>(size.height),
            {samples.get(), samples.get() + 4 * size.pixels()}};
}

Image decodeShown(std::span<const std::uint8_t> bytes, const std::string& name) {
    Size size = findSize(bytes, name);
    requireReadable(name, size.width, size.height, static_cast<std::size_t>(size.channels));
    const std::vector<std::string> channels[] = {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    Image image = makeImage(static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height),
                            channels[std::clamp(size.channels, 1, 4) - 1], Encoding::Srgb);
    const int count = static_cast<int>(image.channels.size());
    if (stbi_is_16_bit_from_memory(bytes.data(), static_cast<int>(bytes.size())) != 0) {
        fill(image.values, decode<stbi_us>(stbi_load_16_from_memory, bytes, name, size, count).get());
    } else {
        fill(image.values, decode<stbi_uc>(stbi_load_from_memory, bytes, name, size, count).get());
    }
    return image;
}

} // namespace nacre
