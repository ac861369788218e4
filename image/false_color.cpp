#include "image/false_color.hpp"

#include "image/color.hpp"
#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre {
namespace {

// CIELAB hue from violet to yellow, degrees, and the chroma in the middle.
constexpr double firstHue = 290;
constexpr double lastHue = 455;
constexpr double largestChroma = 72;

Tristimulus colorOf(double share, double chroma) {
    const double hue = (firstHue + (lastHue - firstHue) * share) * std::numbers::pi / 180;
    return fromLab({100 * share, chroma * std::cos(hue), chroma * std::sin(hue)});
}

bool isShown(const Tristimulus& rgb) {
    return std::ranges::all_of(rgb, [](double value) { return value >= 0 && value <= 1; });
}

} // namespace

std::array<float, 3> heatColor(double share) {
    const double inside = std::clamp(share, 0.0, 1.0);
    double low = 0;
    double high = largestChroma * std::sin(inside * std::numbers::pi);
    if (!isShown(colorOf(inside, high))) {
        for (int step = 0; step < 20; ++step) {
            const double middle = (low + high) / 2;
            (isShown(colorOf(inside, middle)) ? low : high) = middle;
        }
        high = low;
    }
    std::array<float, 3> result{};
    std::ranges::transform(colorOf(inside, high), result.begin(),
                           [](double value) { return encodeSrgb(static_cast<float>(value)); });
    return result;
}

Image heatMap(const Image& map, double largest) {
    requireWhole(map);
    Image result = makeImage(map.width, map.height, {"R", "G", "B"}, Encoding::Srgb);
    constexpr std::size_t steps = 1024;
    std::vector<std::array<float, 3>> table;
    for (std::size_t i = 0; i <= steps; ++i) {
        table.push_back(heatColor(static_cast<double>(i) / steps));
    }
    for (std::size_t pixel = 0; pixel < map.pixelCount(); ++pixel) {
        const double value = map.values[pixel * map.channels.size()] / largest;
        const double share = std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 1;
        std::ranges::copy(table[static_cast<std::size_t>(std::lround(share * steps))],
                          result.values.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
    }
    return result;
}

Image signedDifference(const Image& image, const Image& reference, double largest) {
    requireAlike(image, reference);
    Image result = makeImage(image.width, image.height, image.channels, Encoding::Srgb);
    std::ranges::transform(image.values, reference.values, result.values.begin(), [&](float value, float other) {
        const double difference = 0.5 + (double{value} - other) / (2 * largest);
        return std::isfinite(difference) ? static_cast<float>(std::clamp(difference, 0.0, 1.0)) : 1.0f;
    });
    return result;
}

} // namespace nacre
