// Image files: PNG, JPEG and EXR out; PNG, JPEG, HDR and EXR in. Files appear complete or not at all.
// Every function throws SceneError with one sentence that names the file.
#pragma once

#include "scene/file.hpp"
#include "scene/scene.hpp"

#include <span>

namespace nacre::scene {

/// Longest side of an image that is read, px.
inline constexpr std::uint32_t maxImageSide = 16384;

/// Writes 8-bit RGB(A) (channels 3 or 4), row 0 at the top, already sRGB encoded.
void writePng(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height, int channels,
              std::span<const std::uint8_t> pixels);

/// Writes 8-bit RGB, row 0 at the top, already sRGB encoded, with losses. quality: [1 … 100].
void writeJpeg(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
               std::span<const std::uint8_t> pixels, int quality = 90);

/// How writeExr stores a channel: 16-bit half (relative precision 2⁻¹¹, up to 65504) or 32-bit float.
enum class ExrPrecision { Half, Float };

/// Writes linear half or full float channels. `channelNames` e.g. {"R","G","B"}; pixels are interleaved.
void writeExr(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::string> channelNames, std::span<const float> pixels,
              ExrPrecision precision = ExrPrecision::Float);

/// Reads .hdr or .exr (told apart by content) as linear RGBA floats; alpha is 1 where the file has none, and a
/// file with one channel fills red, green and blue with it.
FloatImage readFloatImage(const std::filesystem::path& file);

/// Reads any 8-bit format that stb_image knows as RGBA.
Texture readTexture(const std::filesystem::path& file, bool srgb);

/// The same from memory; `name` is what an error calls it.
Texture decodeTexture(std::span<const std::uint8_t> bytes, const std::string& name, bool srgb);

} // namespace nacre::scene
