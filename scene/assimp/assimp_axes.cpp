#include "scene/assimp/assimp_axes.hpp"

#include <cstring>
#include <functional>

namespace nacre::scene {
namespace {

constexpr std::uint16_t mainChunk = 0x4d4d;
constexpr std::uint16_t editorChunk = 0x3d3d;
constexpr std::uint16_t meshVersionChunk = 0x3d3e;
constexpr std::uint16_t masterScaleChunk = 0x0100;
constexpr std::size_t headerBytes = 6;

/// Calls visit(identifier, content) on the chunks that follow one another in `bytes`, until it returns true.
bool anyChunk(std::span<const std::uint8_t> bytes,
              const std::function<bool(std::uint16_t, std::span<const std::uint8_t>)>& visit) {
    while (bytes.size() >= headerBytes) {
        std::uint16_t identifier = 0;
        std::uint32_t length = 0;
        std::memcpy(&identifier, bytes.data(), sizeof(identifier));
        std::memcpy(&length, bytes.data() + sizeof(identifier), sizeof(length));
        if (length < headerBytes || length > bytes.size()) {
            return false;
        }
        if (visit(identifier, bytes.subspan(headerBytes, length - headerBytes))) {
            return true;
        }
        bytes = bytes.subspan(length);
    }
    return false;
}

} // namespace

bool hasStudioAxes(std::span<const std::uint8_t> bytes) {
    const auto isMark = [](std::uint16_t identifier, auto) {
        return identifier == meshVersionChunk || identifier == masterScaleChunk;
    };
    const auto inEditor = [&](std::uint16_t identifier, std::span<const std::uint8_t> content) {
        return identifier == editorChunk && anyChunk(content, isMark);
    };
    return anyChunk(bytes, [&](std::uint16_t identifier, std::span<const std::uint8_t> content) {
        return identifier == mainChunk && anyChunk(content, inEditor);
    });
}

} // namespace nacre::scene
