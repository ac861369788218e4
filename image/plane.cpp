#include "image/plane.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nacre {
namespace {

/// The filtered value at a place whose taps may lie beyond the border.
float sumAtBorder(const float* line, std::ptrdiff_t length, std::ptrdiff_t stride, std::ptrdiff_t at,
                  const Taps& taps) {
    const auto radius = static_cast<std::ptrdiff_t>(taps.size() / 2);
    float sum = 0;
    for (std::ptrdiff_t tap = -radius; tap <= radius; ++tap) {
        sum += taps[static_cast<std::size_t>(tap + radius)] *
               line[std::clamp<std::ptrdiff_t>(at + tap, 0, length - 1) * stride];
    }
    return sum;
}

Plane filteredAlongRows(const Plane& plane, const Taps& taps) {
    Plane result{plane.width, plane.height, std::vector<float>(plane.values.size())};
    const auto width = static_cast<std::ptrdiff_t>(plane.width);
    const auto radius = static_cast<std::ptrdiff_t>(taps.size() / 2);
    for (std::size_t row = 0; row < plane.height; ++row) {
        const float* source = &plane.values[row * plane.width];
        float* target = &result.values[row * plane.width];
        for (std::ptrdiff_t x = 0; x < width; ++x) {
            if (x < radius || x + radius >= width) {
                target[x] = sumAtBorder(source, width, 1, x, taps);
                continue;
            }
            float sum = 0;
            for (std::size_t tap = 0; tap < taps.size(); ++tap) {
                sum += taps[tap] * source[x - radius + static_cast<std::ptrdiff_t>(tap)];
            }
            target[x] = sum;
        }
    }
    return result;
}

// Row by row, so that memory is read in its order.
Plane filteredAlongColumns(const Plane& plane, const Taps& taps) {
    Plane result{plane.width, plane.height, std::vector<float>(plane.values.size())};
    const auto height = static_cast<std::ptrdiff_t>(plane.height);
    const auto radius = static_cast<std::ptrdiff_t>(taps.size() / 2);
    for (std::ptrdiff_t y = 0; y < height; ++y) {
        float* target = &result.values[static_cast<std::size_t>(y) * plane.width];
        for (std::ptrdiff_t tap = -radius; tap <= radius; ++tap) {
            const float weight = taps[static_cast<std::size_t>(tap + radius)];
            const std::ptrdiff_t row = std::clamp<std::ptrdiff_t>(y + tap, 0, height - 1);
            const float* source = &plane.values[static_cast<std::size_t>(row) * plane.width];
            for (std::size_t x = 0; x < plane.width; ++x) {
                target[x] += weight * source[x];
            }
        }
    }
    return result;
}

} // namespace

Taps gaussianTaps(double standardDeviation, int radius) {
    std::vector<double> weights;
    for (int tap = -radius; tap <= radius; ++tap) {
        weights.push_back(std::exp(-tap * tap / (2 * standardDeviation * standardDeviation)));
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    Taps taps(weights.size());
    std::ranges::transform(weights, taps.begin(), [&](double weight) { return static_cast<float>(weight / sum); });
    return taps;
}

Plane filtered(const Plane& plane, const Taps& along, const Taps& down) {
    return filteredAlongColumns(filteredAlongRows(plane, along), down);
}

Plane planeOf(const Image& image, std::size_t channel) {
    Plane plane{image.width, image.height, std::vector<float>(image.pixelCount())};
    for (std::size_t pixel = 0; pixel < plane.values.size(); ++pixel) {
        plane.values[pixel] = image.values[pixel * image.channels.size() + channel];
    }
    return plane;
}

} // namespace nacre
