#include "image/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nacre {
namespace {

// Of a linear reference the few brightest values, glints, say little about what full is.
constexpr double peakShare = 0.999;
constexpr double manyStandardErrors = 3;

std::size_t replaceNotFinite(Image& image) {
    std::size_t count = 0;
    for (float& value : image.values) {
        if (!std::isfinite(value)) {
            value = 0;
            ++count;
        }
    }
    return count;
}

FlipSummary summarise(const Image& map, const Mask& mask) {
    return {mean(map, mask), quantile(map, 0.5, mask), quantile(map, 0.95, mask), quantile(map, 1, mask)};
}

double peakOf(const Image& reference, const ComparisonSettings& settings) {
    if (settings.peak > 0) {
        return settings.peak;
    }
    const double bright = reference.encoding == Encoding::Srgb ? 1 : quantile(reference, peakShare, settings.mask);
    return bright > 0 ? bright : 1;
}

void compareLight(Comparison& comparison, const Mask& mask) {
    const std::vector<ErrorSums> sums = channelErrors(toEncoding(comparison.test, Encoding::Linear),
                                                      toEncoding(comparison.reference, Encoding::Linear), mask);
    ErrorSums total;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        comparison.energyRatio[channel] = sums[channel].energyRatio();
        total += sums[channel];
    }
    comparison.relMse = total.relMse();
}

} // namespace

ChanceTest testChance(const Image& image, const Image& reference, const Image& variance, const Mask& mask) {
    requireAlike(image, reference);
    requireAlike(image, variance);
    countedPixels(image, mask); // throws unless the mask fits
    ChanceTest test;
    double sum = 0;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        if ((!mask.empty() && mask[i / image.channels.size()] == 0) || !(variance.values[i] > 0)) {
            continue;
        }
        const double difference = double{image.values[i]} - reference.values[i];
        const double squared = difference * difference / variance.values[i];
        sum += squared;
        beyond += squared > manyStandardErrors * manyStandardErrors ? 1 : 0;
        ++test.count;
    }
    if (test.count > 0) {
        test.beyondShare = static_cast<double>(beyond) / static_cast<double>(test.count);
        test.chiSquared = sum / static_cast<double>(test.count);
    }
    return test;
}

Comparison compareImages(const Image& test, const Image& reference, const ComparisonSettings& settings) {
    if (test.encoding != reference.encoding) {
        throw std::invalid_argument("an image for a display cannot be compared with one of linear light");
    }
    Comparison comparison;
    comparison.test = toRgb(test);
    comparison.reference = toRgb(reference);
    comparison.notFinite = replaceNotFinite(comparison.test);
    comparison.referenceNotFinite = replaceNotFinite(comparison.reference);
    comparison.pixels = countedPixels(comparison.reference, settings.mask);
    if (comparison.pixels == 0) {
        throw std::invalid_argument("no pixel counts");
    }
    comparison.peak = peakOf(comparison.reference, settings);
    comparison.psnr = errors(comparison.test, comparison.reference, settings.mask).psnr(comparison.peak);
    comparison.ssim = mean(ssimMap(comparison.test, comparison.reference, comparison.peak), settings.mask);
    compareLight(comparison, settings.mask);
    if (settings.flip == FlipKind::Hdr) {
        comparison.exposures = flipExposures(comparison.reference);
        comparison.flipMap =
            hdrFlip(comparison.test, comparison.reference, comparison.exposures, settings.pixelsPerDegree);
    } else {
        comparison.flipMap = flip(comparison.test, comparison.reference, settings.pixelsPerDegree);
    }
    comparison.flip = summarise(comparison.flipMap, settings.mask);
    if (!settings.variance.values.empty()) {
        comparison.chance = testChance(comparison.test, comparison.reference, settings.variance, settings.mask);
    }
    return comparison;
}

} // namespace nacre
