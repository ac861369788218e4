#include "bench/suites/image_error.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nacre::bench {
namespace {

constexpr double peakShare = 0.999;
constexpr double relMseEpsilon = 0.01;

float finite(float value) {
    return std::isfinite(value) ? value : 0;
}

void check(const IdentifiedPicture& picture) {
    const std::size_t count = std::size_t{picture.width} * picture.height;
    if (count == 0 || picture.pixels.size() != 3 * count || picture.materialIds.size() != count) {
        throw std::invalid_argument("a picture's pixels and material ids do not fill its size");
    }
}

std::vector<double> valuesWithMaterial(const IdentifiedPicture& picture) {
    std::vector<double> values;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        if (picture.materialIds[i / 3] != 0) {
            values.push_back(finite(picture.pixels[i]));
        }
    }
    return values;
}

// Two neighbours on one axis, and how far the position is from the first to the second.
struct Neighbours {
    std::uint32_t first;
    std::uint32_t second;
    float fraction;
};

// Of the pixel `at` of `to`, among `from` pixels that cover the same length.
Neighbours neighboursOf(std::uint32_t at, std::uint32_t to, std::uint32_t from) {
    const float last = static_cast<float>(from - 1);
    const float position = (static_cast<float>(at) + 0.5f) * static_cast<float>(from) / static_cast<float>(to) - 0.5f;
    const float inside = std::clamp(position, 0.0f, last);
    const auto first = static_cast<std::uint32_t>(inside);
    return {first, std::min(first + 1, from - 1), inside - static_cast<float>(first)};
}

void interpolate(const IdentifiedPicture& picture, const Neighbours& x, const Neighbours& y, float id, float* result) {
    float sum[3] = {0, 0, 0};
    float total = 0;
    const auto add = [&](std::uint32_t column, std::uint32_t row, float weight) {
        const std::size_t index = std::size_t{row} * picture.width + column;
        if (picture.materialIds[index] == id) {
            total += weight;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                sum[channel] += weight * finite(picture.pixels[3 * index + channel]);
            }
        }
    };
    add(x.first, y.first, (1 - x.fraction) * (1 - y.fraction));
    add(x.second, y.first, x.fraction * (1 - y.fraction));
    add(x.first, y.second, (1 - x.fraction) * y.fraction);
    add(x.second, y.second, x.fraction * y.fraction);
    const std::uint32_t column = x.fraction < 0.5f ? x.first : x.second;
    const std::uint32_t row = y.fraction < 0.5f ? y.first : y.second;
    const float* nearest = &picture.pixels[3 * (std::size_t{row} * picture.width + column)];
    for (std::size_t channel = 0; channel < 3; ++channel) {
        result[channel] = total > 0 ? sum[channel] / total : nearest[channel];
    }
}

} // namespace

std::vector<float> enlarge(const IdentifiedPicture& picture, const IdentifiedPicture& guide) {
    std::vector<float> result(guide.pixels.size());
    for (std::uint32_t row = 0; row < guide.height; ++row) {
        const Neighbours y = neighboursOf(row, guide.height, picture.height);
        for (std::uint32_t column = 0; column < guide.width; ++column) {
            const std::size_t index = std::size_t{row} * guide.width + column;
            interpolate(picture, neighboursOf(column, guide.width, picture.width), y, guide.materialIds[index],
                        &result[3 * index]);
        }
    }
    return result;
}

ReferencePicture::ReferencePicture(IdentifiedPicture picture) : reference_(std::move(picture)) {
    check(reference_);
    std::vector<double> values = valuesWithMaterial(reference_);
    if (values.empty()) {
        throw std::invalid_argument("no pixel of the picture has a subsurface material");
    }
    const auto peak = values.begin() + std::lround(peakShare * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), peak, values.end());
    peak_ = *peak;
}

ImageError ReferencePicture::compare(const IdentifiedPicture& picture) const {
    check(picture);
    const bool sameSize = picture.width == reference_.width && picture.height == reference_.height;
    const std::vector<float> enlarged = sameSize ? std::vector<float>() : enlarge(picture, reference_);
    const std::vector<float>& pixels = sameSize ? picture.pixels : enlarged;
    double count = 0;
    double squares = 0;
    double relativeSquares = 0;
    double pictureSum = 0;
    double referenceSum = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (reference_.materialIds[i / 3] == 0) {
            continue;
        }
        const double x = static_cast<double>(finite(pixels[i]));
        const double r = static_cast<double>(finite(reference_.pixels[i]));
        squares += (x - r) * (x - r);
        relativeSquares += (x - r) * (x - r) / (r * r + relMseEpsilon);
        pictureSum += x;
        referenceSum += r;
        ++count;
    }
    const double psnr = 10 * std::log10(peak_ * peak_ * count / squares);
    return {.psnr = squares > 0 ? std::clamp(psnr, 0.0, maxPsnr) : maxPsnr,
            .relMse = relativeSquares / count,
            .energyRatio = referenceSum > 0 ? pictureSum / referenceSum : 1};
}

} // namespace nacre::bench
