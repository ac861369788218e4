#include "nacre/layering.hpp"

#include "fault.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nacre {
namespace {

constexpr Range thicknessRange{1e-6, std::numeric_limits<double>::infinity(), " mm"};

// cosh(a)·sinh(b)/sinh(c) for a, b, c ≥ 0 without overflow; b and c may be infinite with a finite difference b − c.
double hyperbolicRatio(double a, double b, double c, double bMinusC) {
    return 0.5 * std::exp(a + bMinusC) * (1 + std::exp(-2 * a)) * std::expm1(-2 * b) / std::expm1(-2 * c);
}

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
    if (slabs_.empty() || slabs_.size() > maxLayers) {
        throw std::invalid_argument("slabs has " + std::to_string(slabs_.size()) + " entries, must have 1 to " +
                                    std::to_string(maxLayers));
    }
    for (std::size_t i = 0; i < slabs_.size(); ++i) {
        const std::string field = indexed("slabs", i);
        if (const std::string fault = findFault(slabs_[i].medium); !fault.empty()) {
            throw std::invalid_argument(field + ".medium." + fault);
        }
        requireNoFault(findFault(field + ".thickness", slabs_[i].thickness, thicknessRange));
        if (std::isinf(slabs_[i].thickness) && i + 1 < slabs_.size()) {
            throw std::invalid_argument(field + ".thickness is infinite, which only the last may be");
        }
    }
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
        double k = 1e6;
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

LayerFit LayeredMedium::transmittanceLayers(int layerCount) const {
    const Rgb through = diffuseTransmittance();
    if (*std::min_element(through.begin(), through.end()) < 1e-12) {
        throw std::logic_error("the layered medium lets no light through");
    }
    return fit(layerCount, &SlabResponse::transmittanceDown);
}

LayeredMedium layeredSkin() {
    return LayeredMedium({
        {{"epidermis", {4.8, 6.0, 6.5}, {0.21, 0.21, 0.50}, 1.4}, 0.25},
        {{"upper dermis", {3.2, 4.0, 4.6}, {0.016, 0.019, 0.030}, 1.34}, 0.20},
        {{"bloody dermis", {0.45, 0.47, 0.48}, {0.0085, 0.10, 2.5}, 1.4}, std::numeric_limits<double>::infinity()},
    });
}

} // namespace nacre
