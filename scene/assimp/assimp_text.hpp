// What Assimp misreads in texts of OBJ, MTL, PLY and STL.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace nacre::scene {

/// Whether files with this extension (lower case, with its dot) go through clearUp.
bool isAssimpText(std::string_view extension);

/// Takes a byte order mark away, which would hide the first line; calls PLY's diffuse_red "red", and writes the words
/// of an STL's text in small letters.
void clearUp(std::vector<std::uint8_t>& text, std::string_view extension);

/// Whether a material library has textures with the options -s or -o.
bool placesTextures(std::span<const std::uint8_t> text);

} // namespace nacre::scene
