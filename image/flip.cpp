#include "image/flip.hpp"

#include "image/flip_parts.hpp"
#include "image/metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nacre {
namespace {

using Planes = std::array<Plane, 3>;

// Andersson et al. 2020, section 4.2.
constexpr double featureExponent = 0.5;

Image finiteRgb(const Image& image) {
    Image rgb = toRgb(toEncoding(image, Encoding::Linear));
    for (float& value : rgb.values) {
        value = std::isfinite(value) ? std::max(value, 0.0f) : 0.0f;
    }
    return rgb;
}

Tristimulus colorAt(const Image& rgb, std::size_t pixel) {
    return {rgb.values[3 * pixel], rgb.values[3 * pixel + 1], rgb.values[3 * pixel + 2]};
}

Plane makePlane(const Image& like) {
    return {like.width, like.height, std::vector<float>(like.pixelCount())};
}

Planes toOpponents(const Image& rgb) {
    Planes planes{makePlane(rgb), makePlane(rgb), makePlane(rgb)};
    for (std::size_t pixel = 0; pixel < rgb.pixelCount(); ++pixel) {
        const Tristimulus opponents = toYCxCz(colorAt(rgb, pixel));
        for (std::size_t i = 0; i < 3; ++i) {
            planes[i].values[pixel] = static_cast<float>(opponents[i]);
        }
    }
    return planes;
}

Plane filteredByContrast(const Plane& plane, Opponent channel, double pixelsPerDegree) {
    Plane sum{plane.width, plane.height, std::vector<float>(plane.values.size())};
    for (const FilterTerm& term : contrastFilter(channel, pixelsPerDegree)) {
        const Plane part = filtered(plane, term.taps, term.taps);
        for (std::size_t i = 0; i < sum.values.size(); ++i) {
            sum.values[i] += static_cast<float>(term.weight) * part.values[i];
        }
    }
    return sum;
}

/// What is left of every pixel's colour from the observer's distance, in Hunt-adjusted CIELAB.
std::vector<Tristimulus> seenColors(const Planes& opponents, double pixelsPerDegree) {
    Planes seen;
    for (std::size_t i = 0; i < 3; ++i) {
        seen[i] = filteredByContrast(opponents[i], static_cast<Opponent>(i), pixelsPerDegree);
    }
    std::vector<Tristimulus> colors(seen[0].values.size());
    for (std::size_t pixel = 0; pixel < colors.size(); ++pixel) {
        Tristimulus rgb = fromYCxCz({seen[0].values[pixel], seen[1].values[pixel], seen[2].values[pixel]});
        for (double& value : rgb) {
            value = std::clamp(value, 0.0, 1.0);
        }
        colors[pixel] = huntAdjusted(toLab(rgb));
    }
    return colors;
}

/// How strong edges and points are at every pixel, [0, 1].
struct Features {
    std::vector<float> edges;
    std::vector<float> points;
};

std::vector<float> magnitudes(const Plane& luminance, const Taps& derivative, const Taps& across) {
    const Plane x = filtered(luminance, derivative, across);
    const Plane y = filtered(luminance, across, derivative);
    std::vector<float> result(x.values.size());
    std::ranges::transform(x.values, y.values, result.begin(), [](float a, float b) { return std::hypot(a, b); });
    return result;
}

Features findFeatures(const Plane& achromatic, double pixelsPerDegree) {
    Plane luminance = achromatic;
    for (float& value : luminance.values) {
        value = (value + 16) / 116;
    }
    const FeatureFilter filter = featureFilter(pixelsPerDegree);
    return {magnitudes(luminance, filter.edge, filter.across), magnitudes(luminance, filter.point, filter.across)};
}

double featureError(const Features& features, const Features& reference, std::size_t pixel) {
    const double edges = std::abs(features.edges[pixel] - reference.edges[pixel]);
    const double points = std::abs(features.points[pixel] - reference.points[pixel]);
    return std::clamp(std::pow(std::max(edges, points) / std::numbers::sqrt2, featureExponent), 0.0, 1.0);
}

/// What FLIP needs to know of one picture.
struct Look {
    Look(const Image& rgb, double pixelsPerDegree) {
        const Planes opponents = toOpponents(rgb);
        colors = seenColors(opponents, pixelsPerDegree);
        features = findFeatures(opponents[0], pixelsPerDegree);
    }
    std::vector<Tristimulus> colors;
    Features features;
};

/// FLIP of linear colours in [0, 1].
std::vector<float> differences(const Image& rgb, const Image& reference, double pixelsPerDegree) {
    const Look look(rgb, pixelsPerDegree);
    const Look referenceLook(reference, pixelsPerDegree);
    std::vector<float> errors(rgb.pixelCount());
    for (std::size_t pixel = 0; pixel < errors.size(); ++pixel) {
        const double color = flipColorError(hyab(look.colors[pixel], referenceLook.colors[pixel]));
        errors[pixel] =
            static_cast<float>(flipError(color, featureError(look.features, referenceLook.features, pixel)));
    }
    return errors;
}

// Narkowicz 2016 (https://knarkowicz.wordpress.com/2016/01/06/aces-filmic-tone-mapping-curve/) for 0.6 of the value:
// (k₀x² + k₁x) / (k₂x² + k₃x + k₄), Andersson et al. 2021.
constexpr double k0 = 0.6 * 0.6 * 2.51;
constexpr double k1 = 0.6 * 0.03;
constexpr double k2 = 0.6 * 0.6 * 2.43;
constexpr double k3 = 0.6 * 0.59;
constexpr double k4 = 0.14;
/// What of the tone curve's range is nearly white, there.
constexpr double nearlyWhite = 0.85;

// Solves flipToneCurve(x) = nearlyWhite.
double nearlyWhiteValue() {
    const double a = nearlyWhite * k2 - k0;
    const double b = nearlyWhite * k3 - k1;
    const double c = nearlyWhite * k4;
    return (-b - std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

Image exposed(const Image& rgb, double stops) {
    Image result = rgb;
    const double scale = std::exp2(stops);
    for (float& value : result.values) {
        value = static_cast<float>(flipToneCurve(scale * value));
    }
    return result;
}

} // namespace

double pixelsPerDegree(double distanceMeters, double widthMeters, double widthPixels) {
    return distanceMeters * widthPixels / widthMeters * std::numbers::pi / 180;
}

Image flip(const Image& image, const Image& reference, double pixelsPerDegree) {
    Image shown[] = {finiteRgb(image), finiteRgb(reference)};
    requireAlike(shown[0], shown[1]);
    for (Image& rgb : shown) {
        std::ranges::transform(rgb.values, rgb.values.begin(), [](float value) { return std::min(value, 1.0f); });
    }
    return {image.width, image.height, {"FLIP"}, differences(shown[0], shown[1], pixelsPerDegree)};
}

double flipToneCurve(double value) {
    const double x = std::min(value, 1e9); // so that squares stay finite; the curve has long reached 1
    return std::clamp((k0 * x * x + k1 * x) / (k2 * x * x + k3 * x + k4), 0.0, 1.0);
}

ExposureRange flipExposures(const Image& reference) {
    const Image rgb = finiteRgb(reference);
    std::vector<double> luminances(rgb.pixelCount());
    for (std::size_t pixel = 0; pixel < luminances.size(); ++pixel) {
        luminances[pixel] = luminance(colorAt(rgb, pixel));
    }
    const auto median = [](std::vector<double>& values) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    if (median(luminances) == 0) {
        std::erase(luminances, 0.0);
    }
    if (luminances.empty()) {
        return {};
    }
    const double start = std::log2(nearlyWhiteValue() / *std::ranges::max_element(luminances));
    const double stop = std::log2(nearlyWhiteValue() / median(luminances));
    return {start, stop, std::max(2, static_cast<int>(std::ceil(stop - start)))};
}

Image hdrFlip(const Image& image, const Image& reference, const ExposureRange& exposures, double pixelsPerDegree) {
    const Image rgb = finiteRgb(image);
    const Image referenceRgb = finiteRgb(reference);
    requireAlike(rgb, referenceRgb);
    Image largest = makeImage(image.width, image.height, {"FLIP"});
    for (int i = 0; i < exposures.count; ++i) {
        const double share = exposures.count > 1 ? static_cast<double>(i) / (exposures.count - 1) : 0;
        const double stops = exposures.start + share * (exposures.stop - exposures.start);
        const std::vector<float> errors =
            differences(exposed(rgb, stops), exposed(referenceRgb, stops), pixelsPerDegree);
        std::ranges::transform(errors, largest.values, largest.values.begin(),
                               [](float a, float b) { return std::max(a, b); });
    }
    return largest;
}

Image hdrFlip(const Image& image, const Image& reference, double pixelsPerDegree) {
    return hdrFlip(image, reference, flipExposures(reference), pixelsPerDegree);
}

} // namespace nacre
