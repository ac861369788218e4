// Sentences about a JSON text that quote it, but not at any length.
#pragma once

#include <string>
#include <string_view>

namespace nacre {

/// A text of at most some 400 bytes: of a longer one the middle is left out.
inline std::string withoutMiddle(std::string_view text) {
    constexpr std::size_t head = 300;
    constexpr std::size_t tail = 100;
    if (text.size() <= head + tail) {
        return std::string(text);
    }
    // A cut moves to where a character of UTF-8 begins.
    const auto cut = [&](std::size_t at) {
        while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u) {
            ++at;
        }
        return at;
    };
    return std::string(text.substr(0, cut(head))) + " … " + std::string(text.substr(cut(text.size() - tail)));
}

/// What nlohmann's library says of a text, which quotes all that it has read of a string. Without the prefix
/// "[json.exception.parse_error.101] ".
inline std::string jsonFault(std::string_view message) {
    const auto end = message.starts_with('[') ? message.find("] ") : std::string_view::npos;
    return withoutMiddle(end == std::string_view::npos ? message : message.substr(end + 2));
}

} // namespace nacre
