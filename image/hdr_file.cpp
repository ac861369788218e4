// Radiance HDR.
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace nacre {
namespace {

/// Runs take 2 bytes for up to 127 values of one of four channels.
constexpr std::size_t mostHdrPixelsPerByte = 16;

/// Takes one scanline from `rest`, plain or in runs; false when it is not whole.
bool takeScanline(std::span<const std::uint8_t>& rest, std::span<std::uint8_t> rgbe) {
    const std::size_t width = rgbe.size() / 4;
    const bool hasRuns =
        width >= 8 && width < 32768 && rest.size() >= 4 && rest[0] == 2 && rest[1] == 2 && rest[2] < 128;
    if (!hasRuns) {
        if (rest.size() < rgbe.size()) {
            return false;
        }
        std::ranges::copy(rest.first(rgbe.size()), rgbe.begin());
        rest = rest.subspan(rgbe.size());
        return true;
    }
    if (std::size_t{rest[2]} * 256 + rest[3] != width) {
        return false;
    }
    rest = rest.subspan(4);
    for (std::size_t channel = 0; channel < 4; ++channel) {
        for (std::size_t x = 0; x < width;) {
            const bool repeats = !rest.empty() && rest[0] > 128;
            const std::size_t count = rest.empty() ? 0 : rest[0] - (repeats ? 128u : 0u);
            const std::size_t taken = repeats ? 2 : 1 + count;
            if (count == 0 || count > width - x || taken > rest.size()) {
                return false;
            }
            for (std::size_t i = 0; i < count; ++i) {
                rgbe[4 * (x + i) + channel] = rest[repeats ? 1 : 1 + i];
            }
            x += count;
            rest = rest.subspan(taken);
        }
    }
    return true;
}

struct Header {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::span<const std::uint8_t> scanlines; ///< what follows
};

/// The text up to the next end of line, which it takes from `rest` with it.
std::string_view takeLine(std::span<const std::uint8_t>& rest) {
    const auto end = std::ranges::find(rest, '\n');
    const auto length = static_cast<std::size_t>(end - rest.begin());
    const std::string_view line(reinterpret_cast<const char*>(rest.data()), length);
    rest = rest.subspan(std::min(length + 1, rest.size()));
    return line;
}

/// Takes "NAME NUMBER" from the beginning of a line; -1 where there is something else.
std::int64_t takeSide(std::string_view& line, std::string_view name) {
    std::int64_t side = -1;
    if (line.starts_with(name)) {
        line.remove_prefix(name.size());
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), side);
        line.remove_prefix(error == std::errc() ? static_cast<std::size_t>(end - line.data()) : line.size());
        side = error == std::errc() ? side : -1;
    }
    return side;
}

Header readHeader(std::span<const std::uint8_t> rest, const std::string& name) {
    bool isRgbe = false;
    for (std::string_view line = takeLine(rest); !line.empty(); line = takeLine(rest)) {
        isRgbe = isRgbe || line == "FORMAT=32-bit_rle_rgbe";
    }
    if (!isRgbe) {
        throw FileError(name + ": the Radiance header has no line FORMAT=32-bit_rle_rgbe");
    }
    std::string_view line = takeLine(rest);
    const std::string shown(line.substr(0, 60));
    Header header;
    header.height = takeSide(line, "-Y ");
    header.width = takeSide(line, " +X ");
    if (header.height < 0 || header.width < 0 || !line.empty()) {
        throw FileError(name + ": the Radiance header gives the size as \"" + shown +
                        "\", must be \"-Y height +X width\"");
    }
    header.scanlines = rest;
    return header;
}

} // namespace

bool isHdr(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.starts_with("#?RADIANCE\n") || text.starts_with("#?RGBE\n");
}

Image decodeHdr(std::span<const std::uint8_t> bytes, const std::string& name) {
    const auto [width, height, scanlines] = readHeader(bytes, name);
    requireReadable(name, width, height, 3);
    Image image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {"R", "G", "B"}, {}};
    image.values.reserve(3 * std::min(image.pixelCount(), mostHdrPixelsPerByte * scanlines.size()));
    std::vector<std::uint8_t> rgbe(std::size_t{image.width} * 4);
    std::span<const std::uint8_t> rest = scanlines;
    for (std::int64_t row = 0; row < height; ++row) {
        if (!takeScanline(rest, rgbe)) {
            throw FileError(name + ": the Radiance file is damaged or cut off in row " + std::to_string(row) + " of " +
                            std::to_string(height));
        }
        for (std::size_t i = 0; i < rgbe.size(); i += 4) {
            const float unit = rgbe[i + 3] > 0 ? std::ldexp(1.0f, rgbe[i + 3] - (128 + 8)) : 0;
            image.values.insert(image.values.end(), {rgbe[i] * unit, rgbe[i + 1] * unit, rgbe[i + 2] * unit});
        }
    }
    return image;
}

} // namespace nacre
