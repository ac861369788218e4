// Textures from image files. Every function throws SceneError with one sentence that names the file.
#pragma once

#include "scene/scene.hpp"

#include <array>
#include <span>

namespace nacre::scene {

/// Reads any 8-bit format that stb_image knows as RGBA.
Texture readTexture(const std::filesystem::path& file, bool srgb);

/// The same from memory; `name` is what an error calls it.
Texture decodeTexture(std::span<const std::uint8_t> bytes, const std::string& name, bool srgb);

/// The linear value of every one of a texel (IEC 61966-2-1); of alpha, which is linear, with srgb = false.
std::array<double, 256> linearValues(bool srgb);

} // namespace nacre::scene
