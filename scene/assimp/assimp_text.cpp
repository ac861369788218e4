#include "scene/assimp/assimp_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

namespace nacre::scene {
namespace {

constexpr std::array extensions{std::string_view(".obj"), std::string_view(".mtl"), std::string_view(".ply"),
                                std::string_view(".stl")};

std::string_view viewOf(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void removeByteOrderMark(std::vector<std::uint8_t>& text) {
    constexpr std::array<std::uint8_t, 3> mark{0xef, 0xbb, 0xbf};
    if (text.size() >= mark.size() && std::equal(mark.begin(), mark.end(), text.begin())) {
        text.erase(text.begin(), text.begin() + mark.size());
    }
}

/// In the header; what follows may be binary.
void renamePlyColors(std::vector<std::uint8_t>& text) {
    constexpr std::string_view prefix = " diffuse_";
    constexpr std::array colors{std::string_view("red"), std::string_view("green"), std::string_view("blue")};
    const std::size_t end = viewOf(text).substr(0, 1 << 16).find("end_header");
    std::size_t place = end == std::string_view::npos ? end : viewOf(text).substr(0, end).rfind(prefix);
    while (place != std::string_view::npos) {
        const std::string_view rest = viewOf(text).substr(place + prefix.size());
        if (std::ranges::any_of(colors, [&](std::string_view color) { return rest.starts_with(color); })) {
            const auto first = text.begin() + static_cast<std::ptrdiff_t>(place) + 1;
            text.erase(first, first + static_cast<std::ptrdiff_t>(prefix.size()) - 1);
        }
        place = place == 0 ? std::string_view::npos : viewOf(text).substr(0, place).rfind(prefix);
    }
}

void lowerStl(std::vector<std::uint8_t>& text) {
    constexpr std::size_t headerSize = 84;
    constexpr std::size_t facetSize = 50;
    std::uint32_t facets = 0;
    if (text.size() >= headerSize) {
        std::memcpy(&facets, &text[headerSize - sizeof(facets)], sizeof(facets));
    }
    const bool isBinary = text.size() >= headerSize && text.size() >= headerSize + facetSize * std::size_t{facets};
    if (isBinary && viewOf(text).find('\0') != std::string_view::npos) {
        return;
    }
    if (viewOf(text).find("FACET") != std::string_view::npos || viewOf(text).find("Facet") != std::string_view::npos) {
        std::ranges::transform(text, text.begin(), [](std::uint8_t c) { return std::tolower(c); });
    }
}

} // namespace

bool isAssimpText(std::string_view extension) {
    return std::ranges::find(extensions, extension) != extensions.end();
}

void clearUp(std::vector<std::uint8_t>& text, std::string_view extension) {
    removeByteOrderMark(text);
    if (extension == ".ply") {
        renamePlyColors(text);
    } else if (extension == ".stl") {
        lowerStl(text);
    }
}

bool placesTextures(std::span<const std::uint8_t> text) {
    std::string_view rest = viewOf(text);
    while (!rest.empty()) {
        std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (line.starts_with("map_") && (line.find(" -s ") != line.npos || line.find(" -o ") != line.npos)) {
            return true;
        }
    }
    return false;
}

} // namespace nacre::scene
