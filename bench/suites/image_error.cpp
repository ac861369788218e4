#include "bench/suites/image_error.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nacre::bench {
namespace {

constexpr double peakShare = 0.999;

float finite(float value) {
    return std::isfinite(value) ? value : 0;
}

void check(const IdentifiedPicture& picture) {
    const std::size_t count = picture.image.pixelCount();
    if (count == 0 || picture.image.values.size() != 3 * count || picture.materialIds.size() != count) {
        throw std::invalid_argument("a picture's pixels and material ids do not fill its size");
    }
}

Mask maskOf(const std::vector<float>& materialIds) {
    Mask mask(materialIds.size());
    std::ranges::transform(materialIds, mask.begin(), [](float id) { return static_cast<std::uint8_t>(id != 0); });
    return mask;
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
        const std::size_t index = std::size_t{row} * picture.image.width + column;
        if (picture.materialIds[index] == id) {
            total += weight;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                sum[channel] += weight * finite(picture.image.values[3 * index + channel]);
            }
        }
    };
    add(x.first, y.first, (1 - x.fraction) * (1 - y.fraction));
    add(x.second, y.first, x.fraction * (1 - y.fraction));
    add(x.first, y.second, (1 - x.fraction) * y.fraction);
    add(x.second, y.second, x.fraction * y.fraction);
    const std::uint32_t column = x.fraction < 0.5f ? x.first : x.second;
    const std::uint32_t row = y.fraction < 0.5f ? y.first : y.second;
    const float* nearest = &picture.image.values[3 * (std::size_t{row} * picture.image.width + column)];
    for (std::size_t channel = 0; channel < 3; ++channel) {
        result[channel] = total > 0 ? sum[channel] / total : nearest[channel];
    }
}

} // namespace

std::vector<float> enlarge(const IdentifiedPicture& picture, const IdentifiedPicture& guide) {
    std::vector<float> result(guide.image.values.size());
    for (std::uint32_t row = 0; row < guide.image.height; ++row) {
        const Neighbours y = neighboursOf(row, guide.image.height, picture.image.height);
        for (std::uint32_t column = 0; column < guide.image.width; ++column) {
            const std::size_t index = std::size_t{row} * guide.image.width + column;
            interpolate(picture, neighboursOf(column, guide.image.width, picture.image.width), y,
                        guide.materialIds[index], &result[3 * index]);
        }
    }
    return result;
}

ReferencePicture::ReferencePicture(IdentifiedPicture picture) : reference_(std::move(picture)) {
    check(reference_);
    std::ranges::transform(reference_.image.values, reference_.image.values.begin(), finite);
    mask_ = maskOf(reference_.materialIds);
    if (countedPixels(reference_.image, mask_) == 0) {
        throw std::invalid_argument("no pixel of the picture has a subsurface material");
    }
    peak_ = quantile(reference_.image, peakShare, mask_);
}

ImageError ReferencePicture::compare(const IdentifiedPicture& picture) const {
    check(picture);
    const bool sameSize =
        picture.image.width == reference_.image.width && picture.image.height == reference_.image.height;
    Image image = reference_.image;
    image.values = sameSize ? picture.image.values : enlarge(picture, reference_);
    std::ranges::transform(image.values, image.values.begin(), finite);
    const ErrorSums sums = errors(image, reference_.image, mask_);
    const double energyRatio = sums.energyRatio(); // infinite where the reference is black
    return {.psnr = std::clamp(sums.psnr(peak_), 0.0, maxPsnr),
            .relMse = sums.relMse(),
            .energyRatio = std::isfinite(energyRatio) ? energyRatio : 1};
}

} // namespace nacre::bench
