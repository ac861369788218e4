// Radiance HDR.
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <algorithm>
#include <cmath>
#include <stb/stb_image.h>

namespace nacre {
namespace {

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

/// What follows the empty line that ends the header, and the line with the size after it.
std::span<const std::uint8_t> scanlinesOf(std::span<const std::uint8_t> bytes) {
    const auto headerEnd = std::ranges::adjacent_find(
        bytes, [](std::uint8_t one, std::uint8_t next) { return one == '\n' && next == '\n'; });
    const auto afterHeader = headerEnd + std::min<std::ptrdiff_t>(2, bytes.end() - headerEnd);
    const auto sizeEnd = std::find(afterHeader, bytes.end(), '\n');
    return {sizeEnd + (sizeEnd == bytes.end() ? 0 : 1), bytes.end()};
}

} // namespace

bool isHdr(std::span<const std::uint8_t> bytes) {
    return stbi_is_hdr_from_memory(bytes.data(), static_cast<int>(bytes.size())) != 0;
}

/// stb_image knows the header; it would wait without end for the scanlines that a file lacks.
Image decodeHdr(std::span<const std::uint8_t> bytes, const std::string& name) {
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels) == 0) {
        throw FileError(name + ": the Radiance header is damaged: " + stbi_failure_reason());
    }
    requireReadable(name, width, height, 3);
    Image image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {"R", "G", "B"}, {}};
    image.values.reserve(image.pixelCount() * 3);
    std::vector<std::uint8_t> rgbe(std::size_t{image.width} * 4);
    std::span<const std::uint8_t> rest = scanlinesOf(bytes);
    for (int row = 0; row < height; ++row) {
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
