// Image files: PNG and EXR out; PNG, JPEG, HDR and EXR in. Files appear complete or not at all.
#pragma once

#include "scene/scene.hpp"

#include <span>

namespace nacre::scene {

/// Writes 8-bit RGB(A) (channels 3 or 4), row 0 at the top, already sRGB encoded.
void writePng(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height, int channels,
              std::span<const std::uint8_t> pixels);

/// Writes linear half or full float channels. `channelNames` e.g. {"R","G","B"}; pixels are interleaved.
void writeExr(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::string> channelNames, std::span<const float> pixels);

/// Reads .hdr or .exr as linear RGBA floats.
FloatImage readFloatImage(const std::filesystem::path& file);

/// Reads any 8-bit format that stb_image knows as RGBA.
Texture readTexture(const std::filesystem::path& file, bool srgb);

/// Writes bytes to `file` by way of a temporary neighbour and a rename; throws SceneError naming the file.
void writeFileAtomically(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

} // namespace nacre::scene
