#include "app/bench/image_error.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nacre::bench {
namespace {

constexpr double peakShare = 0.999;
constexpr double relMseEpsilon = 0.01;

double finite(float value) {
    return std::isfinite(value) ? static_cast<double>(value) : 0;
}

} // namespace

ImageError compareImages(std::span<const float> picture, std::span<const float> reference,
                         std::span<const float> materialIds) {
    if (picture.size() != reference.size() || picture.size() != 3 * materialIds.size()) {
        throw std::invalid_argument("pictures of different sizes cannot be compared");
    }
    std::vector<double> values;
    double squares = 0;
    double relativeSquares = 0;
    double pictureSum = 0;
    double referenceSum = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if (materialIds[i / 3] == 0) {
            continue;
        }
        const double x = finite(picture[i]);
        const double r = finite(reference[i]);
        values.push_back(r);
        squares += (x - r) * (x - r);
        relativeSquares += (x - r) * (x - r) / (r * r + relMseEpsilon);
        pictureSum += x;
        referenceSum += r;
    }
    if (values.empty()) {
        throw std::invalid_argument("no pixel of the picture has a subsurface material");
    }
    std::sort(values.begin(), values.end());
    const auto count = static_cast<double>(values.size());
    const double peak = percentile(values, peakShare);
    const double psnr = 10 * std::log10(peak * peak * count / squares);
    return {.psnr = squares > 0 ? std::clamp(psnr, 0.0, maxPsnr) : maxPsnr,
            .relMse = relativeSquares / count,
            .energyRatio = referenceSum > 0 ? pictureSum / referenceSum : 1};
}

} // namespace nacre::bench
