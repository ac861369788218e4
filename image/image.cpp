#include "image/image.hpp"

#include "image/color.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nacre {

Image makeImage(std::uint32_t width, std::uint32_t height, std::vector<std::string> channels, Encoding encoding) {
    Image image{width, height, std::move(channels), {}, encoding};
    image.values.resize(image.pixelCount() * image.channels.size());
    return image;
}

void requireWhole(const Image& image) {
    const std::size_t count = image.pixelCount() * image.channels.size();
    if (count == 0 || count != image.values.size()) {
        throw std::invalid_argument("an image of " + std::to_string(image.width) + " x " +
                                    std::to_string(image.height) + " pixels and " +
                                    std::to_string(image.channels.size()) + " channels cannot have " +
                                    std::to_string(image.values.size()) + " values");
    }
}

std::optional<std::size_t> findChannel(const Image& image, std::string_view name) {
    const auto found = std::ranges::find(image.channels, name);
    if (found == image.channels.end()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - image.channels.begin());
}

Image selectChannels(const Image& image, std::span<const std::string> names) {
    requireWhole(image);
    std::vector<std::size_t> places;
    for (const std::string& name : names) {
        const std::optional<std::size_t> place = findChannel(image, name);
        if (!place) {
            throw std::invalid_argument("has no channel " + name);
        }
        places.push_back(*place);
    }
    Image result = makeImage(image.width, image.height, {names.begin(), names.end()}, image.encoding);
    auto value = result.values.begin();
    for (std::size_t pixel = 0; pixel < image.values.size(); pixel += image.channels.size()) {
        for (const std::size_t place : places) {
            *value++ = image.values[pixel + place];
        }
    }
    return result;
}

Image toRgb(const Image& image) {
    const std::vector<std::string> rgb{"R", "G", "B"};
    if (image.channels.size() != 1) {
        return selectChannels(image, rgb);
    }
    Image result = selectChannels(image, std::vector<std::string>(3, image.channels.front()));
    result.channels = rgb;
    return result;
}

Image toEncoding(Image image, Encoding encoding) {
    if (image.encoding == encoding) {
        return image;
    }
    const std::size_t alpha = findChannel(image, "A").value_or(image.channels.size());
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        float& value = image.values[i];
        if (i % image.channels.size() != alpha && !std::isnan(value)) {
            value = encoding == Encoding::Srgb ? encodeSrgb(value) : decodeSrgb(value);
        }
    }
    image.encoding = encoding;
    return image;
}

Image reduced(const Image& image, std::uint32_t factor) {
    requireWhole(image);
    if (factor == 0 || image.width % factor != 0 || image.height % factor != 0) {
        throw std::invalid_argument("an image of " + std::to_string(image.width) + " x " +
                                    std::to_string(image.height) + " pixels has no blocks of " +
                                    std::to_string(factor) + " a side");
    }
    Image result = makeImage(image.width / factor, image.height / factor, image.channels, image.encoding);
    const float share = 1 / static_cast<float>(factor * factor);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const std::span<const float> source = image.at(x, y);
            const std::span<float> sum = result.at(x / factor, y / factor);
            for (std::size_t channel = 0; channel < source.size(); ++channel) {
                sum[channel] += share * source[channel];
            }
        }
    }
    return result;
}

} // namespace nacre
