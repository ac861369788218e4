// Image files in and out: PNG, JPEG, OpenEXR and Radiance HDR. Files appear complete or not at all. Every function
// throws FileError with one sentence that names the file. Target nacre::image_files.
#pragma once

#include "image/image.hpp"
#include "nacre/files.hpp"

#include <filesystem>

namespace nacre {

/// Longest side of an image that is read, px.
inline constexpr std::uint32_t maxImageSide = 16384;

/// Reads an image of any kind, told apart by content, with the channels that it has. OpenEXR and Radiance files are
/// linear; R, G, B and A come first, the others follow by name. Others (PNG with 8 and 16 bits, JPEG, WebP, BMP, TGA)
/// are values in [0, 1] with Encoding::Srgb, and their channels Y, YA, RGB or RGBA.
Image readImage(const std::filesystem::path& file);

/// Reads an OpenEXR or a Radiance file as linear R, G, B and A; alpha is 1 where the file has none, and a file with one
/// channel fills red, green and blue with it.
Image readRadiance(const std::filesystem::path& file);

/// readImage and readRadiance of a file that is in memory; `name` is what an error calls it.
Image decodeImage(std::span<const std::uint8_t> bytes, const std::string& name);
Image decodeRadiance(std::span<const std::uint8_t> bytes, const std::string& name);

/// How writeExr stores a channel: 16-bit half (relative precision 2⁻¹¹, up to 65504) or 32-bit float.
enum class ExrPrecision { Half, Float };

/// Writes the values as they are, all channels by their names, compressed without loss but for what Half rounds.
void writeExr(const std::filesystem::path& file, const Image& image, ExrPrecision precision = ExrPrecision::Float);

/// Writes 8 bits of 1 (grey), 3 (RGB) or 4 (RGBA) channels; linear images are sRGB encoded on the way. Values are
/// rounded to the nearest step and cut off at 0 and 1.
void writePng(const std::filesystem::path& file, const Image& image);

/// The same of 3 channels as a JPEG, with losses. quality: [1 … 100].
void writeJpeg(const std::filesystem::path& file, const Image& image, int quality = 90);

/// Writes R, G and B with a shared exponent: relative precision 2⁻⁸ of the largest of the three.
void writeHdr(const std::filesystem::path& file, const Image& image);

/// writeExr, writePng, writeJpeg or writeHdr, by the ending of the file's name: .exr, .png, .jpg, .jpeg or .hdr.
void writeImage(const std::filesystem::path& file, const Image& image);

/// A picture in a format that is known and not read. Whoever names it may leave it out and say so; one that is missing
/// or broken is a FileError like any other.
struct UnreadPicture : FileError {
    using FileError::FileError;
};

/// An 8-bit picture as it is in its file: what textures are made of.
struct ByteImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba; ///< width · height · 4 bytes, row 0 at the top
};

/// Decodes a PNG, JPEG, WebP, BMP or TGA from memory; `name` is what an error calls it. Of 16 bits it keeps the
/// upper 8. Throws UnreadPicture for another format whose beginning is known, FileError for what cannot be read.
ByteImage decodeBytes(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace nacre
