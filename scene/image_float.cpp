#include "scene/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <stb/stb_image.h>
#include <tinyexr.h>

namespace nacre::scene {
namespace {

/// Most pixels of a float image (1 GiB as RGBA).
constexpr std::uint64_t maxFloatPixels = std::uint64_t{1} << 26;

constexpr std::array<std::uint8_t, 4> exrMagic{0x76, 0x2f, 0x31, 0x01};

/// tinyexr's error text, freed.
std::string takeMessage(const char* message) {
    std::string result = message != nullptr ? message : "unknown reason";
    FreeEXRErrorMessage(message);
    while (!result.empty() && (result.back() == '\n' || result.back() == '.')) {
        result.pop_back();
    }
    return result;
}

struct ExrHeader : EXRHeader {
    ExrHeader() { InitEXRHeader(this); }
    ExrHeader(const ExrHeader&) = delete;
    ~ExrHeader() { FreeEXRHeader(this); }
};

void checkSize(const std::string& name, std::int64_t width, std::int64_t height) {
    if (width <= 0 || height <= 0 || std::max(width, height) > maxImageSide ||
        static_cast<std::uint64_t>(width * height) > maxFloatPixels) {
        throw SceneError(name + ": image of " + std::to_string(width) + " x " + std::to_string(height) +
                         " pixels cannot be read, 1 to " + std::to_string(maxImageSide) + " a side and at most " +
                         std::to_string(maxFloatPixels) + " in all");
    }
}

struct ExrImage : EXRImage {
    ExrImage() { InitEXRImage(this); }
    ExrImage(const ExrImage&) = delete;
    ~ExrImage() {
        if (isLoaded) { // tinyexr frees what it could not load, and does not reset the pointers
            FreeEXRImage(this);
        }
    }
    bool isLoaded = false;
};

/// The file's channels for red, green, blue and alpha; -1 for an alpha that is not there.
std::array<int, 4> findChannels(const EXRHeader& header, const std::string& name) {
    std::array<int, 4> found{-1, -1, -1, -1};
    constexpr std::array names{"R", "G", "B", "A"};
    for (int channel = 0; channel < header.num_channels; ++channel) {
        for (std::size_t i = 0; i < names.size(); ++i) {
            found[i] = std::strcmp(header.channels[channel].name, names[i]) == 0 ? channel : found[i];
        }
    }
    if (header.num_channels == 1) {
        found = {0, 0, 0, -1};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (found[i] < 0) {
            throw SceneError(name + ": has no channel " + names[i]);
        }
    }
    return found;
}

/// Copies a block of `planes`, `stride` pixels wide, to (x, y) as far as it is inside the image.
void copyBlock(unsigned char** planes, const std::array<int, 4>& channels, std::size_t stride, std::size_t rows,
               std::size_t x, std::size_t y, FloatImage& image) {
    for (std::size_t row = 0; row < rows && y + row < image.height; ++row) {
        for (std::size_t column = 0; column < stride && x + column < image.width; ++column) {
            float* pixel = &image.pixels[((y + row) * image.width + x + column) * 4];
            for (std::size_t i = 0; i < 4; ++i) {
                const auto* plane = channels[i] >= 0 ? reinterpret_cast<const float*>(planes[channels[i]]) : nullptr;
                pixel[i] = plane != nullptr ? plane[row * stride + column] : 1.0f;
            }
        }
    }
}

FloatImage decodeExr(std::span<const std::uint8_t> bytes, const std::string& name) {
    EXRVersion version{};
    if (ParseEXRVersionFromMemory(&version, bytes.data(), bytes.size()) != TINYEXR_SUCCESS) {
        throw SceneError(name + ": the OpenEXR header is damaged");
    }
    if (version.multipart != 0 || version.non_image != 0) {
        throw SceneError(name + ": multi-part and deep OpenEXR files are not supported");
    }
    const char* message = nullptr;
    ExrHeader header;
    if (ParseEXRHeaderFromMemory(&header, &version, bytes.data(), bytes.size(), &message) != TINYEXR_SUCCESS) {
        throw SceneError(name + ": the OpenEXR header is damaged: " + takeMessage(message));
    }
    const EXRBox2i& box = header.data_window;
    checkSize(name, std::int64_t{box.max_x} - box.min_x + 1, std::int64_t{box.max_y} - box.min_y + 1);
    for (int channel = 0; channel < header.num_channels; ++channel) {
        if (header.pixel_types[channel] == TINYEXR_PIXELTYPE_UINT) {
            throw SceneError(name + ": integer channels of OpenEXR are not supported");
        }
        header.requested_pixel_types[channel] = TINYEXR_PIXELTYPE_FLOAT;
    }
    const std::array<int, 4> channels = findChannels(header, name);
    ExrImage source;
    source.num_channels = header.num_channels; // else tinyexr does not free the planes of what it could not load
    if (LoadEXRImageFromMemory(&source, &header, bytes.data(), bytes.size(), &message) != TINYEXR_SUCCESS) {
        throw SceneError(name + ": the OpenEXR file cannot be decoded: " + takeMessage(message));
    }
    source.isLoaded = true;
    FloatImage image;
    image.width = static_cast<std::uint32_t>(source.width);
    image.height = static_cast<std::uint32_t>(source.height);
    image.pixels.resize(std::size_t{image.width} * image.height * 4);
    if (source.images != nullptr) {
        copyBlock(source.images, channels, image.width, image.height, 0, 0, image);
    }
    const auto tileWidth = static_cast<std::size_t>(header.tile_size_x);
    const auto tileHeight = static_cast<std::size_t>(header.tile_size_y);
    for (int i = 0; source.tiles != nullptr && i < source.num_tiles; ++i) {
        const EXRTile& tile = source.tiles[i];
        copyBlock(tile.images, channels, tileWidth, tileHeight, static_cast<std::size_t>(tile.offset_x) * tileWidth,
                  static_cast<std::size_t>(tile.offset_y) * tileHeight, image);
    }
    return image;
}

/// Takes one scanline from `rest`, plain or in runs; false when it is not whole.
bool takeScanline(std::span<const std::uint8_t>& rest, std::span<std::uint8_t> rgbe) {
    const std::size_t width = rgbe.size() / 4;
    const bool hasRuns =
        width >= 8 && width < 32768 && rest.size() >= 4 && rest[0] == 2 && rest[1] == 2 && rest[2] < 128;
    if (!hasRuns) {
        if (rest.size() < rgbe.size()) {
            return false;
        }
        std::ranges::copy(rest.first(rgbe.size()), rgbe.begin());
        rest = rest.subspan(rgbe.size());
        return true;
    }
    if (std::size_t{rest[2]} * 256 + rest[3] != width) {
        return false;
    }
    rest = rest.subspan(4);
    for (std::size_t channel = 0; channel < 4; ++channel) {
        for (std::size_t x = 0; x < width;) {
            const bool repeats = !rest.empty() && rest[0] > 128;
            const std::size_t count = rest.empty() ? 0 : rest[0] - (repeats ? 128u : 0u);
            const std::size_t taken = repeats ? 2 : 1 + count;
            if (count == 0 || count > width - x || taken > rest.size()) {
                return false;
            }
            for (std::size_t i = 0; i < count; ++i) {
                rgbe[4 * (x + i) + channel] = rest[repeats ? 1 : 1 + i];
            }
            x += count;
            rest = rest.subspan(taken);
        }
    }
    return true;
}

/// What follows the empty line that ends the header, and the line with the size after it.
std::span<const std::uint8_t> scanlinesOf(std::span<const std::uint8_t> bytes) {
    const auto headerEnd = std::ranges::adjacent_find(
        bytes, [](std::uint8_t one, std::uint8_t next) { return one == '\n' && next == '\n'; });
    const auto afterHeader = headerEnd + std::min<std::ptrdiff_t>(2, bytes.end() - headerEnd);
    const auto sizeEnd = std::find(afterHeader, bytes.end(), '\n');
    return {sizeEnd + (sizeEnd == bytes.end() ? 0 : 1), bytes.end()};
}

/// stb_image knows the header; it would wait without end for the scanlines that a file lacks.
FloatImage decodeHdr(std::span<const std::uint8_t> bytes, const std::string& name) {
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels) == 0) {
        throw SceneError(name + ": the Radiance header is damaged: " + stbi_failure_reason());
    }
    checkSize(name, width, height);
    FloatImage image;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.pixels.reserve(std::size_t{image.width} * image.height * 4);
    std::vector<std::uint8_t> rgbe(std::size_t{image.width} * 4);
    std::span<const std::uint8_t> rest = scanlinesOf(bytes);
    for (int row = 0; row < height; ++row) {
        if (!takeScanline(rest, rgbe)) {
            throw SceneError(name + ": the Radiance file is damaged or cut off in row " + std::to_string(row) + " of " +
                             std::to_string(height));
        }
        for (std::size_t i = 0; i < rgbe.size(); i += 4) {
            const float unit = rgbe[i + 3] > 0 ? std::ldexp(1.0f, rgbe[i + 3] - (128 + 8)) : 0;
            image.pixels.insert(image.pixels.end(), {rgbe[i] * unit, rgbe[i + 1] * unit, rgbe[i + 2] * unit, 1});
        }
    }
    return image;
}

} // namespace

FloatImage readFloatImage(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    if (bytes.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        if (bytes.size() >= exrMagic.size() && std::equal(exrMagic.begin(), exrMagic.end(), bytes.begin())) {
            return decodeExr(bytes, file.string());
        }
        if (stbi_is_hdr_from_memory(bytes.data(), static_cast<int>(bytes.size())) != 0) {
            return decodeHdr(bytes, file.string());
        }
    }
    throw SceneError(file.string() + ": is neither an OpenEXR nor a Radiance .hdr image");
}

void writeExr(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::string> channelNames, std::span<const float> pixels, ExrPrecision precision) {
    const std::size_t channelCount = channelNames.size();
    const std::size_t pixelCount = std::size_t{width} * height;
    const bool namesFit = std::ranges::all_of(channelNames, [](const std::string& name) {
        return !name.empty() && name.size() < sizeof(EXRChannelInfo::name);
    });
    if (pixelCount == 0 || channelCount == 0 || !namesFit || pixelCount * channelCount != pixels.size()) {
        throw SceneError(file.string() + ": cannot write an OpenEXR file of " + std::to_string(width) + " x " +
                         std::to_string(height) + " pixels and " + std::to_string(channelCount) + " channels from " +
                         std::to_string(pixels.size()) + " values");
    }
    std::vector<std::size_t> order(channelCount); // the format wants its channels in alphabetical order
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t channel) { return channelNames[channel]; });

    std::vector<std::vector<float>> planes(channelCount, std::vector<float>(pixelCount));
    std::vector<unsigned char*> planePointers(channelCount);
    std::vector<EXRChannelInfo> channels(channelCount, EXRChannelInfo{});
    std::vector<int> types(channelCount, TINYEXR_PIXELTYPE_FLOAT);
    std::vector<int> storedTypes(channelCount,
                                 precision == ExrPrecision::Half ? TINYEXR_PIXELTYPE_HALF : TINYEXR_PIXELTYPE_FLOAT);
    for (std::size_t plane = 0; plane < channelCount; ++plane) {
        for (std::size_t pixel = 0; pixel < pixelCount; ++pixel) {
            planes[plane][pixel] = pixels[pixel * channelCount + order[plane]];
        }
        planePointers[plane] = reinterpret_cast<unsigned char*>(planes[plane].data());
        std::strcpy(channels[plane].name, channelNames[order[plane]].c_str());
    }

    EXRImage image;
    InitEXRImage(&image);
    image.num_channels = static_cast<int>(channelCount);
    image.images = planePointers.data();
    image.width = static_cast<int>(width);
    image.height = static_cast<int>(height);
    EXRHeader header;
    InitEXRHeader(&header);
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    header.num_channels = image.num_channels;
    header.channels = channels.data();
    header.pixel_types = types.data();
    header.requested_pixel_types = storedTypes.data();

    unsigned char* encoded = nullptr;
    const char* message = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&image, &header, &encoded, &message);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owner(encoded, std::free);
    if (size == 0) {
        throw SceneError(file.string() + ": the OpenEXR encoder failed: " + takeMessage(message));
    }
    writeFileAtomically(file, std::span(encoded, size));
}

} // namespace nacre::scene
