// What Assimp misreads in texts of OBJ, MTL, PLY and STL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::scene {

/// Whether files with this extension (lower case, with its dot) go through clearUp.
bool isAssimpText(std::string_view extension);

/// Takes a byte order mark away, which would hide the first line; puts each material library that an OBJ names
/// into a line of its own; calls PLY's diffuse_red "red"; writes the words of an STL's text in small letters.
void clearUp(std::vector<std::uint8_t>& text, std::string_view extension);

/// Makes comments of the lines of an OBJ that begin objects and groups, where these are more than `most`. Whether it
/// did.
bool joinObjects(std::vector<std::uint8_t>& text, std::size_t most);

/// Whether a material library has textures with the options -s or -o.
bool placesTextures(std::span<const std::uint8_t> text);

/// What follows the word in lines that begin with it, as "usemtl".
std::set<std::string> namesAfter(std::string_view word, std::span<const std::uint8_t> text);

} // namespace nacre::scene
