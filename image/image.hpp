// A picture in memory: what the renderer gives, what image files hold, and what the metrics compare.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

/// What the values of an image mean.
enum class Encoding {
    Linear, ///< proportional to light, without an upper bound; Rec.709 primaries where the channels are colours
    Srgb,   ///< [0, 1] for a display, by the transfer function of IEC 61966-2-1
};

/// Pixels with named channels: `channels.size()` floats each, row 0 at the top.
struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::string> channels; ///< e.g. {"R", "G", "B"}, {"Z"} or {"R", "G", "B", "variance.R"}
    std::vector<float> values;         ///< width · height · channels.size()
    Encoding encoding = Encoding::Linear;

    std::size_t pixelCount() const { return std::size_t{width} * height; }
    /// The channels of one pixel.
    std::span<const float> at(std::uint32_t x, std::uint32_t y) const {
        return std::span(values).subspan((std::size_t{y} * width + x) * channels.size(), channels.size());
    }
    std::span<float> at(std::uint32_t x, std::uint32_t y) {
        return std::span(values).subspan((std::size_t{y} * width + x) * channels.size(), channels.size());
    }
    bool operator==(const Image&) const = default;
};

/// An image of zeros.
Image makeImage(std::uint32_t width, std::uint32_t height, std::vector<std::string> channels,
                Encoding encoding = Encoding::Linear);

/// Throws std::invalid_argument, saying so, unless the image has a pixel, a channel, and as many values as they take.
void requireWhole(const Image& image);

/// The place of a channel in `image.channels`; nothing where there is none of that name.
std::optional<std::size_t> findChannel(const Image& image, std::string_view name);

/// These channels of the image, in this order. Throws std::invalid_argument, naming the channel that it lacks.
Image selectChannels(const Image& image, std::span<const std::string> names);

/// Channels R, G and B of the image; an image of one channel has it three times. Throws std::invalid_argument, naming
/// the channel that it lacks.
Image toRgb(const Image& image);

/// The image with another encoding, but for channel A; values below 0 and above 1 are cut off on the way to Srgb. NaN
/// stays what it is.
Image toEncoding(Image image, Encoding encoding);

/// The mean of every `factor` x `factor` pixels. Throws std::invalid_argument when that does not divide the sides.
Image reduced(const Image& image, std::uint32_t factor);

} // namespace nacre
