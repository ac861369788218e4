// One pair of functions a kind of image file; image_file.hpp puts them together.
#pragma once

#include "image/image_file.hpp"

namespace nacre {

/// Most pixels of a float image (1 GiB as RGBA).
inline constexpr std::uint64_t maxFloatPixels = std::uint64_t{1} << 26;

/// Throws FileError unless a float image of that size may be read.
void requireReadable(const std::string& name, std::int64_t width, std::int64_t height, std::size_t channels);

bool isExr(std::span<const std::uint8_t> bytes);
bool isHdr(std::span<const std::uint8_t> bytes);

/// Which channels of an OpenEXR file are decoded: all, or R, G, B and A (of a file with one channel, that).
enum class ExrChannels { All, Color };

Image decodeExr(std::span<const std::uint8_t> bytes, const std::string& name, ExrChannels wanted);
Image decodeHdr(std::span<const std::uint8_t> bytes, const std::string& name);
/// What stb_image knows, with 8 or 16 bits.
Image decodeShown(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace nacre
