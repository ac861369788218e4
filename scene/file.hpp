// Whole files in and out. Output appears complete or not at all.
#pragma once

#include "scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace nacre::scene {

/// Largest file that is read at all, bytes.
inline constexpr std::uint64_t maxFileBytes = std::uint64_t{2} << 30;

/// Reads a whole file of up to `maxFileBytes`; throws SceneError naming the file and the system's reason.
std::vector<std::uint8_t> readFile(const std::filesystem::path& file);

/// Writes bytes to `file` by way of a temporary neighbour, fsync and a rename; the neighbour is removed on failure.
/// An existing device or pipe is written in place. Throws SceneError naming the file and the system's reason.
void writeFileAtomically(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

} // namespace nacre::scene
