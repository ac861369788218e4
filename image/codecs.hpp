// One pair of functions a kind of image file; image_file.hpp puts them together.
#pragma once

#include "image/image_file.hpp"

#include <span>
#include <string>
#include <vector>

namespace nacre {

/// Most pixels of a float image (512 MiB as RGBA).
inline constexpr std::uint64_t maxFloatPixels = std::uint64_t{1} << 25;

/// Throws FileError unless a float image of that size may be read.
void requireReadable(const std::string& name, std::int64_t width, std::int64_t height, std::size_t channels);

bool isExr(std::span<const std::uint8_t> bytes);
bool isHdr(std::span<const std::uint8_t> bytes);

/// Which channels of an OpenEXR file are decoded: all, or R, G, B and A (of a file with one channel, that).
enum class ExrChannels { All, Color };

Image decodeExr(std::span<const std::uint8_t> bytes, const std::string& name, ExrChannels wanted);
Image decodeHdr(std::span<const std::uint8_t> bytes, const std::string& name);

/// A picture of whole numbers, as its file has it.
struct IntegerImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::size_t channels = 0;         ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
    std::vector<std::uint8_t> bytes;  ///< 8 bits a sample; empty where there are words
    std::vector<std::uint16_t> words; ///< 16 bits a sample
};

/// Throws FileError unless a picture of whole numbers of that size may be read.
void requireShowable(const std::string& name, std::uint64_t width, std::uint64_t height);

bool isPng(std::span<const std::uint8_t> bytes);
bool isJpeg(std::span<const std::uint8_t> bytes);
bool isWebp(std::span<const std::uint8_t> bytes);
IntegerImage decodePng(std::span<const std::uint8_t> bytes, const std::string& name);
IntegerImage decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name);
IntegerImage decodeWebp(std::span<const std::uint8_t> bytes, const std::string& name);
/// BMP and TGA, in a child process.
IntegerImage decodeBitmap(std::span<const std::uint8_t> bytes, const std::string& name);
/// The same in this process.
IntegerImage decodeBitmapHere(std::span<const std::uint8_t> bytes, const std::string& name);

/// Any of these, with 8 or 16 bits.
Image decodeShown(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace nacre
