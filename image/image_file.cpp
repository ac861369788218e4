#include "image/image_file.hpp"

#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace nacre {
namespace {

/// The channels R, G, B and A, of which alpha may be missing; of one channel, grey.
Image toRgba(Image image, const std::string& name) {
    if (image.channels == std::vector<std::string>{"R", "G", "B", "A"}) {
        return image; // which may be too large to have twice
    }
    const bool isGrey = image.channels.size() == 1;
    std::array<std::optional<std::size_t>, 4> places{0, 0, 0, std::nullopt};
    const std::vector<std::string> rgba{"R", "G", "B", "A"};
    for (std::size_t i = 0; !isGrey && i < rgba.size(); ++i) {
        places[i] = findChannel(image, rgba[i]);
        if (!places[i] && i < 3) {
            throw FileError(name + ": has no channel " + rgba[i]);
        }
    }
    Image result = makeImage(image.width, image.height, rgba);
    for (std::size_t pixel = 0; pixel < result.pixelCount(); ++pixel) {
        for (std::size_t i = 0; i < 4; ++i) {
            result.values[4 * pixel + i] = places[i] ? image.values[pixel * image.channels.size() + *places[i]] : 1.0f;
        }
    }
    return result;
}

bool isSmallEnough(std::span<const std::uint8_t> bytes) {
    return bytes.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max());
}

} // namespace

void requireReadable(const std::string& name, std::int64_t width, std::int64_t height, std::size_t channels) {
    const std::size_t quadruples = (channels + 3) / 4;
    if (width <= 0 || height <= 0 || std::max(width, height) > maxImageSide ||
        static_cast<std::uint64_t>(width * height) * quadruples > maxFloatPixels) {
        throw FileError(name + ": image of " + std::to_string(width) + " x " + std::to_string(height) +
                        " pixels cannot be read, 1 to " + std::to_string(maxImageSide) + " a side and at most " +
                        std::to_string(maxFloatPixels / std::max<std::size_t>(quadruples, 1)) + " in all");
    }
}

Image decodeImage(std::span<const std::uint8_t> bytes, const std::string& name) {
    if (isSmallEnough(bytes) && isExr(bytes)) {
        return decodeExr(bytes, name, ExrChannels::All);
    }
    if (isHdr(bytes)) {
        return decodeHdr(bytes, name);
    }
    return decodeShown(bytes, name);
}

Image decodeRadiance(std::span<const std::uint8_t> bytes, const std::string& name) {
    if (isSmallEnough(bytes) && isExr(bytes)) {
        return toRgba(decodeExr(bytes, name, ExrChannels::Color), name);
    }
    if (isHdr(bytes)) {
        return toRgba(decodeHdr(bytes, name), name);
    }
    throw FileError(name + ": is neither an OpenEXR nor a Radiance .hdr image");
}

Image readImage(const std::filesystem::path& file) {
    return decodeImage(readFile(file), file.string());
}

Image readRadiance(const std::filesystem::path& file) {
    return decodeRadiance(readFile(file), file.string());
}

void writeImage(const std::filesystem::path& file, const Image& image) {
    const std::string ending = file.extension().string();
    if (ending == ".exr") {
        writeExr(file, image);
    } else if (ending == ".png") {
        writePng(file, image);
    } else if (ending == ".jpg" || ending == ".jpeg") {
        writeJpeg(file, image);
    } else if (ending == ".hdr") {
        writeHdr(file, image);
    } else {
        throw FileError(file.string() + ": the name of an image file ends in .png, .jpg, .exr or .hdr, not '" + ending +
                        "'");
    }
}

} // namespace nacre
