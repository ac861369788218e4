#include "image/metrics.hpp"

#include "image/plane.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace nacre {
namespace {

// Wang et al. 2004, section III.C.
constexpr double ssimDeviation = 1.5;
constexpr int ssimRadius = 5;
constexpr double ssimK1 = 0.01;
constexpr double ssimK2 = 0.03;

std::string sizeOf(const Image& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels";
}

void requireFits(const Image& image, const Mask& mask) {
    if (!mask.empty() && mask.size() != image.pixelCount()) {
        throw std::invalid_argument("a mask of " + std::to_string(mask.size()) + " pixels does not fit an image of " +
                                    sizeOf(image));
    }
}

bool counts(const Mask& mask, std::size_t pixel) {
    return mask.empty() || mask[pixel] != 0;
}

Plane product(const Plane& a, const Plane& b) {
    Plane result = a;
    std::ranges::transform(a.values, b.values, result.values.begin(), std::multiplies<>());
    return result;
}

// The similarity of one channel, added to `sum`.
void addSimilarity(const Plane& x, const Plane& y, double peak, Plane& sum) {
    const Taps taps = gaussianTaps(ssimDeviation, ssimRadius);
    const auto blurred = [&](const Plane& plane) { return filtered(plane, taps, taps).values; };
    const std::vector<float> meanX = blurred(x);
    const std::vector<float> meanY = blurred(y);
    const std::vector<float> meanXX = blurred(product(x, x));
    const std::vector<float> meanYY = blurred(product(y, y));
    const std::vector<float> meanXY = blurred(product(x, y));
    const double c1 = ssimK1 * peak * ssimK1 * peak;
    const double c2 = ssimK2 * peak * ssimK2 * peak;
    for (std::size_t i = 0; i < sum.values.size(); ++i) {
        const double mx = meanX[i];
        const double my = meanY[i];
        const double varianceX = std::max(meanXX[i] - mx * mx, 0.0);
        const double varianceY = std::max(meanYY[i] - my * my, 0.0);
        const double covariance = meanXY[i] - mx * my;
        sum.values[i] += static_cast<float>((2 * mx * my + c1) * (2 * covariance + c2) /
                                            ((mx * mx + my * my + c1) * (varianceX + varianceY + c2)));
    }
}

} // namespace

void requireAlike(const Image& image, const Image& reference) {
    requireWhole(image);
    requireWhole(reference);
    if (image.width != reference.width || image.height != reference.height) {
        throw std::invalid_argument("an image of " + sizeOf(image) + " cannot be compared with one of " +
                                    sizeOf(reference));
    }
    if (image.channels != reference.channels) {
        throw std::invalid_argument("images with different channels cannot be compared");
    }
}

double psnr(double meanSquaredError, double peak) {
    if (meanSquaredError == 0) {
        return std::numeric_limits<double>::infinity(); // of black pictures, too
    }
    return 10 * std::log10(peak * peak / meanSquaredError);
}

ErrorSums& ErrorSums::operator+=(const ErrorSums& other) {
    count_ += other.count_;
    squares_ += other.squares_;
    relativeSquares_ += other.relativeSquares_;
    valueSum_ += other.valueSum_;
    referenceSum_ += other.referenceSum_;
    return *this;
}

std::size_t countedPixels(const Image& image, const Mask& mask) {
    requireFits(image, mask);
    return image.pixelCount() - static_cast<std::size_t>(std::ranges::count(mask, std::uint8_t{0}));
}

std::vector<ErrorSums> channelErrors(const Image& image, const Image& reference, const Mask& mask) {
    requireAlike(image, reference);
    requireFits(image, mask);
    std::vector<ErrorSums> sums(image.channels.size());
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        if (counts(mask, i / sums.size())) {
            sums[i % sums.size()].add(image.values[i], reference.values[i]);
        }
    }
    return sums;
}

ErrorSums errors(const Image& image, const Image& reference, const Mask& mask) {
    ErrorSums total;
    for (const ErrorSums& sums : channelErrors(image, reference, mask)) {
        total += sums;
    }
    return total;
}

double quantile(const Image& image, double share, const Mask& mask) {
    requireFits(image, mask);
    std::vector<float> values;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        if (counts(mask, i / image.channels.size())) {
            values.push_back(image.values[i]);
        }
    }
    if (values.empty()) {
        return 0;
    }
    const auto place = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

Image ssimMap(const Image& image, const Image& reference, double peak) {
    requireAlike(image, reference);
    Plane sum{image.width, image.height, std::vector<float>(image.pixelCount())};
    for (std::size_t channel = 0; channel < image.channels.size(); ++channel) {
        addSimilarity(planeOf(image, channel), planeOf(reference, channel), peak, sum);
    }
    for (float& value : sum.values) {
        value /= static_cast<float>(image.channels.size());
    }
    return {image.width, image.height, {"SSIM"}, std::move(sum.values), Encoding::Linear};
}

double mean(const Image& map, const Mask& mask) {
    requireWhole(map);
    requireFits(map, mask);
    double sum = 0;
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        sum += counts(mask, i / map.channels.size()) ? map.values[i] : 0;
    }
    return sum / static_cast<double>(countedPixels(map, mask) * map.channels.size());
}

} // namespace nacre
