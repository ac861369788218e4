// Which way is up in formats that Assimp cannot know it of.
#pragma once

#include <cstdint>
#include <span>

namespace nacre::scene {

/// Whether a 3DS file states the version of its meshes (chunk 0x3D3E) or its master scale (0x0100) as 3D Studio, whose
/// Z points up, and lib3ds do. Converters of other programs write neither, and leave the axes of their own world,
/// mostly with Y up.
bool hasStudioAxes(std::span<const std::uint8_t> bytes);

} // namespace nacre::scene
