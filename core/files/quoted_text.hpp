// Texts of files as sentences quote them: never at any length.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

/// A text of at most some `most` bytes: of a longer one the middle is left out.
inline std::string withoutMiddle(std::string_view text, std::size_t most = 400) {
    if (text.size() <= most) {
        return std::string(text);
    }
    // A cut moves to where a character of UTF-8 begins, which has at most three more bytes.
    const auto cut = [&](std::size_t at) {
        const std::size_t last = std::min(at + 3, text.size());
        while (at < last && (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u) {
            ++at;
        }
        return at;
    };
    const std::size_t tail = most / 4;
    return std::string(text.substr(0, cut(most - tail))) + " … " + std::string(text.substr(cut(text.size() - tail)));
}

/// A name of at most some 100 bytes, in quotation marks.
inline std::string inQuotes(std::string_view name) {
    return '"' + withoutMiddle(name, 100) + '"';
}

/// The names of items, quoted, as a sentence lists them: the first twenty.
template <typename Item> std::string listNames(const std::vector<Item>& items) {
    constexpr std::size_t most = 20;
    std::string result;
    for (std::size_t i = 0; i < std::min(items.size(), most); ++i) {
        result += (result.empty() ? "" : ", ") + inQuotes(items[i].name);
    }
    const std::string more = items.size() > most ? " and " + std::to_string(items.size() - most) + " more" : "";
    return result.empty() ? "none" : result + more;
}

} // namespace nacre
