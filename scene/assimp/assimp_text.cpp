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

constexpr std::string_view blanks = " \t\r"; // the last ends lines

/// Takes the first line off a text: without its ending, and without blanks around it.
std::string_view takeLine(std::string_view& rest) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    return line.substr(0, line.find_last_not_of(blanks) + 1);
}

/// Whether a line begins with the word, which is taken off then, with the blanks behind it.
bool takeWord(std::string_view& line, std::string_view word) {
    if (!line.starts_with(word) || line.find_first_of(blanks) != word.size()) {
        return false;
    }
    line.remove_prefix(line.find_first_not_of(blanks, word.size()));
    return true;
}

/// The names in "mtllib a.mtl b.mtl"; one name where a part is not that of a library.
std::vector<std::string_view> librariesIn(std::string_view names) {
    std::vector<std::string_view> parts;
    for (std::string_view rest = names; !rest.empty();) {
        const std::string_view part = rest.substr(0, rest.find_first_of(blanks));
        rest.remove_prefix(std::min(rest.find_first_not_of(blanks, part.size()), rest.size()));
        parts.push_back(part);
    }
    const bool areLibraries = std::ranges::all_of(parts, [](std::string_view part) { return part.ends_with(".mtl"); });
    return areLibraries ? parts : std::vector{names};
}

/// One library a line.
void divideLibraries(std::vector<std::uint8_t>& text) {
    std::string divided;
    std::size_t copied = 0;
    const std::string_view whole = viewOf(text);
    for (std::string_view rest = whole; !rest.empty();) {
        const std::size_t begin = whole.size() - rest.size();
        std::string_view line = takeLine(rest);
        if (!takeWord(line, "mtllib")) {
            continue;
        }
        if (const auto libraries = librariesIn(line); libraries.size() > 1) {
            divided += whole.substr(copied, begin - copied);
            for (const std::string_view library : libraries) {
                divided += "mtllib " + std::string(library) + "\n";
            }
            copied = whole.size() - rest.size();
        }
    }
    if (copied > 0) {
        divided += whole.substr(copied);
        text.assign(divided.begin(), divided.end());
    }
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
    if (extension == ".obj") {
        divideLibraries(text);
    } else if (extension == ".ply") {
        renamePlyColors(text);
    } else if (extension == ".stl") {
        lowerStl(text);
    }
}

bool joinObjects(std::vector<std::uint8_t>& text, std::size_t most) {
    std::vector<std::size_t> places;
    const std::string_view whole = viewOf(text);
    for (std::string_view rest = whole; !rest.empty();) {
        std::string_view line = takeLine(rest);
        const std::size_t place = static_cast<std::size_t>(line.data() - whole.data());
        if (takeWord(line, "o") || takeWord(line, "g")) {
            places.push_back(place);
        }
    }
    if (places.size() <= most) {
        return false;
    }
    for (const std::size_t place : places) {
        text[place] = '#';
    }
    return true;
}

bool placesTextures(std::span<const std::uint8_t> text) {
    std::string_view rest = viewOf(text);
    while (!rest.empty()) {
        const std::string_view line = takeLine(rest);
        if (line.starts_with("map_") && (line.find(" -s ") != line.npos || line.find(" -o ") != line.npos)) {
            return true;
        }
    }
    return false;
}

std::set<std::string> namesAfter(std::string_view word, std::span<const std::uint8_t> text) {
    std::set<std::string> names;
    std::string_view last; // a name is often repeated line by line
    for (std::string_view rest = viewOf(text); !rest.empty();) {
        std::string_view line = takeLine(rest);
        if (takeWord(line, word) && line != last) {
            names.emplace(last = line);
        }
    }
    return names;
}

} // namespace nacre::scene
