#include "nacre/layering.hpp"

#include "fault.hpp"
#include "nacre/gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nacre {
namespace {

// cosh(a)·sinh(b)/sinh(c) for a, b, c ≥ 0 without overflow; b and c may be infinite with a finite difference b − c.
double hyperbolicRatio(double a, double b, double c, double bMinusC) {
    return 0.5 * std::exp(a + bMinusC) * (1 + std::exp(-2 * a)) * std::expm1(-2 * b) / std::expm1(-2 * c);
}

// [1/mm] Beyond it nothing that scatters has anything left.
constexpr double highestFrequency = 1e6;

// Gauss and Legendre's rule with eight points on [−1, 1].
constexpr std::array gaussNodes{-0.9602898564975363, -0.7966664774136267, -0.5255324099163290, -0.1834346424956498,
                                0.1834346424956498,  0.5255324099163290,  0.7966664774136267,  0.9602898564975363};
constexpr std::array gaussWeights{0.1012285362903763, 0.2223810344533745, 0.3137066458778873, 0.3626837833783620,
                                  0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

struct Sides {
    double reflectance;
    double transmittance;
};

// The average Fresnel reflectance F that boundaryFactor, (1 + F)/(1 − F), is made of, of light in a medium of this
// relative index; none towards a denser one, where it would be counted when it enters.
double internalReflectance(double relativeIndex) {
    const double factor = boundaryFactor(relativeIndex);
    return relativeIndex > 1 ? std::max(0.0, (factor - 1) / (factor + 1)) : 0;
}

// Where a beam meets something for the first time, and how much of it never does.
struct Source {
    double depth;
    double unscattered;
};

// The mean of the exponential distribution of a beam's first event, over those inside the slab.
Source sourceOf(double meanFreePath, double thickness) {
    if (std::isinf(thickness)) {
        return {meanFreePath, 0};
    }
    const double depths = thickness / meanFreePath;
    return {meanFreePath * (1 - depths / std::expm1(depths)), std::exp(-depths)};
}

// Of the light that the source scatters, lit from above. near, far: extrapolation distances z_b at the two boundaries.
Sides scatteredFromAbove(double albedo, const Source& source, double thickness, double q, double near, double far) {
    const double whole = thickness + near + far;
    const double behind = thickness + far - source.depth; // from the source to the far extrapolated boundary
    const double before = source.depth + near;
    const double scattered = albedo * (1 - source.unscattered);
    const double reflectance = scattered * hyperbolicRatio(q * near, q * behind, q * whole, -q * before);
    if (std::isinf(thickness)) {
        return {reflectance, 0};
    }
    return {reflectance, scattered * hyperbolicRatio(q * far, q * before, q * whole, -q * behind)};
}

// Adds what passes as it came. Light from a denser neighbour than the one behind is partly reflected at the face there,
// and is then a beam of the other direction, which leaves where it came from.
Sides withUnscattered(const Sides& scattered, const Sides& scatteredBack, double unscattered, double reflectedBehind) {
    const double back = unscattered * reflectedBehind;
    return {scattered.reflectance + back * (scatteredBack.transmittance + unscattered),
            scattered.transmittance + unscattered - back + back * scatteredBack.reflectance};
}

} // namespace

SlabResponse slabResponse(const Slab& slab, int channel, double k, double above, double below) {
    const double extinction = slab.medium.reducedScattering[channel] + slab.medium.absorption[channel];
    const double albedo = slab.medium.reducedScattering[channel] / extinction;
    const double meanFreePath = 1 / extinction;
    // A floor far below any absorption keeps the ratio of the hyperbolic functions defined at k = 0 without absorption.
    const double q = std::max(std::sqrt(k * k + 3 * slab.medium.absorption[channel] * extinction), 1e-7 / meanFreePath);
    const auto extrapolation = [&](double neighbour) {
        return 2.0 / 3 * boundaryFactor(slab.medium.refractiveIndex / neighbour) * meanFreePath;
    };
    const double top = extrapolation(above);
    const double bottom = extrapolation(below);
    const Source source = sourceOf(meanFreePath, slab.thickness);
    const Sides down = scatteredFromAbove(albedo, source, slab.thickness, q, top, bottom);
    if (std::isinf(slab.thickness)) {
        return {down.reflectance, 0, 0, 0};
    }
    const Sides up = scatteredFromAbove(albedo, source, slab.thickness, q, bottom, top);
    const Sides allDown = withUnscattered(down, up, source.unscattered, internalReflectance(above / below));
    const Sides allUp = withUnscattered(up, down, source.unscattered, internalReflectance(below / above));
    return {allDown.reflectance, allUp.reflectance, allDown.transmittance, allUp.transmittance};
}

SlabResponse stacked(const SlabResponse& top, const SlabResponse& bottom) {
    const double echoes = 1 / (1 - top.reflectanceBottom * bottom.reflectanceTop);
    return {top.reflectanceTop + top.transmittanceDown * bottom.reflectanceTop * top.transmittanceUp * echoes,
            bottom.reflectanceBottom +
                bottom.transmittanceUp * top.reflectanceBottom * bottom.transmittanceDown * echoes,
            top.transmittanceDown * bottom.transmittanceDown * echoes,
            bottom.transmittanceUp * top.transmittanceUp * echoes};
}

LayeredMedium::LayeredMedium(std::vector<Slab> slabs) : slabs_(std::move(slabs)) {
    requireNoFault(findFault(std::span<const Slab>(slabs_)));
}

SlabResponse LayeredMedium::response(int channel, double k) const {
    SlabResponse result;
    for (std::size_t i = slabs_.size(); i-- > 0;) {
        const double above = i > 0 ? slabs_[i - 1].medium.refractiveIndex : 1;
        const bool last = i + 1 == slabs_.size();
        const double below = last ? 1 : slabs_[i + 1].medium.refractiveIndex;
        const SlabResponse slab = slabResponse(slabs_[i], channel, k, above, below);
        result = last ? slab : stacked(slab, result);
    }
    return result;
}

Rgb LayeredMedium::diffuseReflectance() const {
    return {response(0, 0).reflectanceTop, response(1, 0).reflectanceTop, response(2, 0).reflectanceTop};
}

Rgb LayeredMedium::diffuseTransmittance() const {
    return {response(0, 0).transmittanceDown, response(1, 0).transmittanceDown, response(2, 0).transmittanceDown};
}

Rgb LayeredMedium::rmsRadius() const {
    // R̃(k) = R̃(0)·(1 − ⟨r²⟩k²/4 + …), read where the drop is a millionth.
    Rgb result;
    for (int channel = 0; channel < 3; ++channel) {
        const Slab& last = slabs_.back();
        if (std::isinf(last.thickness) && last.medium.absorption[channel] == 0) {
            result[channel] = std::numeric_limits<double>::infinity();
            continue;
        }
        const double zero = response(channel, 0).reflectanceTop;
        const auto drop = [&](double k) { return 1 - response(channel, k).reflectanceTop / zero; };
        double k = 1e-6;
        while (k < 1e6 && drop(k) < 1e-6) {
            k *= 1.1;
        }
        result[channel] = 2 / k * std::sqrt(std::max(0.0, drop(k)));
    }
    return result;
}

LayerFit LayeredMedium::fit(int layerCount, double SlabResponse::*side) const {
    const Rgb whole{response(0, 0).*side, response(1, 0).*side, response(2, 0).*side};
    const auto spectrum = [&](int channel, double k) { return response(channel, k).*side / whole[channel]; };
    // From where every channel is still whole to where none has anything left that changes: what passes a stack
    // unscattered has every frequency.
    double low = 1e6;
    double high = 1e-6;
    for (int channel = 0; channel < 3; ++channel) {
        double k = highestFrequency;
        const double rest = spectrum(channel, k);
        while (k > 1e-6 && spectrum(channel, k) < rest + 0.01 * (1 - rest)) {
            k *= 0.9;
        }
        high = std::max(high, k);
        while (k > 1e-6 && spectrum(channel, k) < rest + 0.995 * (1 - rest)) {
            k *= 0.9;
        }
        low = std::min(low, k);
    }
    constexpr int frequencyCount = 160;
    std::vector<double> frequencies;
    for (int i = 0; i < frequencyCount; ++i) {
        frequencies.push_back(low * std::pow(high / low, double(i) / (frequencyCount - 1)));
    }
    return fitLayersToSpectrum(spectrum, frequencies, layerCount);
}

LayerFit LayeredMedium::reflectanceLayers(int layerCount) const {
    return fit(layerCount, &SlabResponse::reflectanceTop);
}

double LayeredMedium::reflectanceCdf(int channel, double r) const {
    if (r <= 0) {
        return 0;
    }
    // What comes back at every frequency leaves where it entered.
    const double unscattered = response(channel, highestFrequency).reflectanceTop;
    const double whole = response(channel, 0).reflectanceTop;
    const auto scattered = [&](double k) { return response(channel, k).reflectanceTop - unscattered; };
    // From zero to zero of the Bessel function, and finer at the start, where the transform falls.
    constexpr int halfWaves = 500;
    const double halfWave = std::numbers::pi / r;
    double sum = 0;
    double from = 0;
    while (from < halfWaves * halfWave && scattered(from) > 1e-9 * whole) {
        const double to = from + std::min(halfWave, std::max(0.5 * from, 1e-4 * halfWave));
        for (std::size_t i = 0; i < gaussNodes.size(); ++i) {
            const double k = std::lerp(from, to, 0.5 + 0.5 * gaussNodes[i]);
            sum += 0.5 * (to - from) * gaussWeights[i] * scattered(k) * ::j1(k * r);
        }
        from = to;
    }
    // The rest by parts: ∫ f J₁(kr) r dk from K on is f(K)J₀(Kr) but for a term with the derivative of f.
    return (unscattered + r * sum + scattered(from) * ::j0(from * r)) / whole;
}

Rgb LayeredMedium::cdfError(std::span<const Layer> layers) const {
    const SumOfGaussiansProfile profile(std::vector<Layer>(layers.begin(), layers.end()));
    constexpr int radiusCount = 48;
    Rgb result{};
    for (int channel = 0; channel < 3; ++channel) {
        const double low = std::max(profile.inverseCdf(channel, 0.005), 1e-6);
        const double high = std::max(profile.inverseCdf(channel, 0.999), low);
        for (int i = 0; i < radiusCount; ++i) {
            const double r = low * std::pow(high / low, double(i) / (radiusCount - 1));
            result[channel] = std::max(result[channel], std::abs(profile.cdf(channel, r) - reflectanceCdf(channel, r)));
        }
    }
    return result;
}

LayerFit LayeredMedium::transmittanceLayers(int layerCount) const {
    const Rgb through = diffuseTransmittance();
    if (*std::min_element(through.begin(), through.end()) < 1e-12) {
        throw std::logic_error("the layered medium lets no light through");
    }
    return fit(layerCount, &SlabResponse::transmittanceDown);
}

std::vector<Layer> layersOf(std::span<const Slab> slabs) {
    const LayeredMedium medium({slabs.begin(), slabs.end()});
    std::vector<Layer> layers = medium.reflectanceLayers(slabLayerCount).layers;
    for (Layer& layer : layers) { // half spaces that absorb nothing have no widest radius
        layer.variance = std::clamp(layer.variance, varianceRange.low, varianceRange.high);
    }
    return layers;
}

void describeBySlabs(Material& material, std::vector<Slab> slabs) {
    material.layers = layersOf(slabs);
    material.meanFreePath.reset();
    const Rgb reflectance = LayeredMedium(slabs).diffuseReflectance();
    for (std::size_t channel = 0; channel < 3; ++channel) {
        material.albedo[channel] = std::clamp(reflectance[channel], 0.0, 1.0);
    }
    const double n = slabs.front().medium.refractiveIndex;
    material.specular = std::min(1.0, std::pow((n - 1) / (n + 1), 2) / 0.08);
    material.slabs = std::move(slabs);
}

LayeredMedium layeredSkin() {
    return LayeredMedium({
        {{"epidermis", {4.8, 6.0, 6.5}, {0.21, 0.21, 0.50}, 1.4}, 0.25},
        {{"upper dermis", {3.2, 4.0, 4.6}, {0.016, 0.019, 0.030}, 1.34}, 0.20},
        {{"bloody dermis", {0.45, 0.47, 0.48}, {0.0085, 0.10, 2.5}, 1.4}, std::numeric_limits<double>::infinity()},
    });
}

} // namespace nacre
