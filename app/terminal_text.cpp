#include "app/terminal_text.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

namespace nacre::app {

namespace {

struct Decoded {
    std::uint32_t codePoint = 0;
    std::size_t length = 0; ///< bytes; 0 for what is no UTF-8
};

Decoded decode(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80    ? 1
                               : first < 0xc2  ? 0 // a continuation, or a longer form of ASCII
                               : first < 0xe0  ? 2
                               : first < 0xf0  ? 3
                               : first <= 0xf4 ? 4
                                               : 0;
    if (length == 0 || length > text.size()) {
        return {};
    }
    std::uint32_t codePoint = length == 1 ? first : first & (0x7fU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0U) != 0x80) {
            return {};
        }
        codePoint = codePoint << 6 | (byte(i) & 0x3fU);
    }
    constexpr std::array<std::uint32_t, 5> shortest{0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = codePoint >= 0xd800 && codePoint <= 0xdfff;
    return codePoint < shortest[length] || codePoint > 0x10ffff || surrogate ? Decoded{} : Decoded{codePoint, length};
}

bool isControl(std::uint32_t codePoint) {
    return codePoint < 0x20 || (codePoint >= 0x7f && codePoint < 0xa0);
}

bool turnsDirection(std::uint32_t codePoint) {
    return codePoint == 0x061c || codePoint == 0x200e || codePoint == 0x200f ||
           (codePoint >= 0x202a && codePoint <= 0x202e) || (codePoint >= 0x2066 && codePoint <= 0x2069);
}

std::string escape(const char* format, std::uint32_t value) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

} // namespace

std::string printable(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const auto [codePoint, length] = decode(text);
        if (length == 0) {
            result += escape("\\x%02x", static_cast<unsigned char>(text[0]));
        } else if (codePoint == '\n' || codePoint == '\r' || codePoint == '\t') {
            result += ' ';
        } else if (isControl(codePoint)) {
            result += escape("\\x%02x", codePoint);
        } else if (turnsDirection(codePoint) || codePoint == 0x2028 || codePoint == 0x2029) {
            result += escape("\\u%04x", codePoint);
        } else {
            result += text.substr(0, length);
        }
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return result;
}

std::string printableLines(std::string_view text) {
    std::string result;
    for (std::size_t end = text.find('\n'); end != text.npos; end = text.find('\n')) {
        result += printable(text.substr(0, end)) + '\n';
        text.remove_prefix(end + 1);
    }
    return result + printable(text);
}

} // namespace nacre::app
