#include "nacre/media.hpp"

#include "fault.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre {
namespace {

constexpr Range scatteringRange{1e-4, 1e6, " 1/mm"};
constexpr Range absorptionRange{0, 1e6, " 1/mm"};
constexpr Range refractiveIndexRange{1, 3, ""};
constexpr Range anisotropyRange{-0.99, 0.99, ""};

// The dipole of one channel.
struct Dipole {
    double reducedAlbedo;
    double meanFreePath;         // 1/σt′
    double transport;            // σtr, 1/mm
    std::array<double, 2> depth; // of the real and the virtual source, mm

    Dipole(const Medium& medium, int channel) {
        const double extinction = medium.reducedScattering[channel] + medium.absorption[channel];
        reducedAlbedo = medium.reducedScattering[channel] / extinction;
        meanFreePath = 1 / extinction;
        transport = std::sqrt(3 * medium.absorption[channel] * extinction);
        const double diffusion = meanFreePath / 3;
        depth = {meanFreePath, meanFreePath + 4 * boundaryFactor(medium.refractiveIndex) * diffusion};
    }

    double radial(double r) const {
        double sum = 0;
        for (const double z : depth) {
            const double distance = std::hypot(r, z);
            sum += z * (1 + transport * distance) * std::exp(-transport * distance) / (distance * distance * distance);
        }
        return reducedAlbedo / (4 * std::numbers::pi) * sum;
    }

    // ∫₀ʳ of radial.
    double within(double r) const {
        double sum = 0;
        for (const double z : depth) {
            const double distance = std::hypot(r, z);
            sum += std::exp(-transport * z) - z * std::exp(-transport * distance) / distance;
        }
        return 0.5 * reducedAlbedo * sum;
    }

    double total() const {
        return 0.5 * reducedAlbedo * (std::exp(-transport * depth[0]) + std::exp(-transport * depth[1]));
    }
};

Dipole makeDipole(const Medium& medium, int channel) {
    requireNoFault(findFault(medium));
    return {medium, channel};
}

} // namespace

std::span<const MeasuredMedium> jensenMedia() {
    static const std::vector<MeasuredMedium> media{
        {{"Apple", {2.29, 2.39, 1.97}, {0.0030, 0.0034, 0.046}, 1.3}, {0.85, 0.84, 0.53}},
        {{"Chicken1", {0.15, 0.21, 0.38}, {0.015, 0.077, 0.19}, 1.3}, {0.31, 0.15, 0.10}},
        {{"Chicken2", {0.19, 0.25, 0.32}, {0.018, 0.088, 0.20}, 1.3}, {0.32, 0.16, 0.10}},
        {{"Cream", {7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}, 1.3}, {0.98, 0.90, 0.73}},
        {{"Ketchup", {0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}, 1.3}, {0.16, 0.01, 0.00}},
        {{"Marble", {2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}, 1.5}, {0.83, 0.79, 0.75}},
        {{"Potato", {0.68, 0.70, 0.55}, {0.0024, 0.0090, 0.12}, 1.3}, {0.77, 0.62, 0.21}},
        {{"Skim milk", {0.70, 1.22, 1.90}, {0.0014, 0.0025, 0.0142}, 1.3}, {0.81, 0.81, 0.69}},
        {{"Skin1", {0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}, 1.3}, {0.44, 0.22, 0.13}},
        {{"Skin2", {1.09, 1.59, 1.79}, {0.013, 0.070, 0.145}, 1.3}, {0.63, 0.44, 0.34}},
        {{"Spectralon", {11.6, 20.4, 14.9}, {0, 0, 0}, 1.3}, {1, 1, 1}},
        {{"Whole milk", {2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}, 1.3}, {0.91, 0.88, 0.76}},
    };
    return media;
}

std::string findFault(const Medium& medium) {
    if (auto fault = findFault("reducedScattering", medium.reducedScattering, scatteringRange); !fault.empty()) {
        return fault;
    }
    if (auto fault = findFault("absorption", medium.absorption, absorptionRange); !fault.empty()) {
        return fault;
    }
    if (auto fault = findFault("anisotropy", medium.anisotropy, anisotropyRange); !fault.empty()) {
        return fault;
    }
    return findFault("refractiveIndex", medium.refractiveIndex, refractiveIndexRange);
}

double boundaryFactor(double refractiveIndex) {
    const double n = refractiveIndex;
    const double reflectance = n >= 1 ? -1.440 / (n * n) + 0.710 / n + 0.668 + 0.0636 * n
                                      : -0.4399 + 0.7099 / n - 0.3319 / (n * n) + 0.0636 / (n * n * n);
    return (1 + reflectance) / (1 - reflectance);
}

Rgb diffuseReflectance(const Medium& medium) {
    Rgb result;
    for (int channel = 0; channel < 3; ++channel) {
        result[channel] = makeDipole(medium, channel).total();
    }
    return result;
}

double dipoleCdf(const Medium& medium, int channel, double r) {
    const Dipole dipole = makeDipole(medium, channel);
    return dipole.within(r) / dipole.total();
}

RadialProfile dipoleProfile(const Medium& medium) {
    const std::array dipoles{makeDipole(medium, 0), makeDipole(medium, 1), makeDipole(medium, 2)};
    double support = 0;
    for (const Dipole& dipole : dipoles) {
        const double most = 1000 * dipole.meanFreePath;
        double radius = dipole.meanFreePath;
        while (radius < most && dipole.within(radius) < (1 - 1e-6) * dipole.total()) {
            radius *= 1.1;
        }
        support = std::max(support, std::min(radius, most));
    }
    return {[dipoles](int channel, double r) { return dipoles[channel].radial(r); }, support};
}

double reducedAlbedo(double singleScatteringAlbedo, double anisotropy) {
    const double a = singleScatteringAlbedo;
    return a < 1 ? a * (1 - anisotropy) / (1 - a * anisotropy) : 1;
}

double reducedMeanFreePath(double meanFreePath, double singleScatteringAlbedo, double anisotropy) {
    return meanFreePath / (1 - singleScatteringAlbedo * anisotropy);
}

double diffuseAlbedo(double singleScatteringAlbedo, double anisotropy) {
    const double q = std::sqrt(1 - reducedAlbedo(singleScatteringAlbedo, anisotropy));
    return (1 - q) * (1 - 0.139 * q) / (1 + 1.17 * q);
}

double singleScatteringAlbedo(double diffuseAlbedo, double anisotropy) {
    const double c = diffuseAlbedo;
    const double root = std::sqrt(9.59217 + 41.6808 * c + 17.7126 * c * c);
    const double q = std::clamp(4.09712 + 4.20863 * c - root, 0.0, 1.0);
    return q > 0 ? (1 - q * q) / (1 - anisotropy * q * q) : 1;
}

double chiangSingleScatteringAlbedo(double diffuseAlbedo) {
    const double a = diffuseAlbedo;
    return 1 - std::exp(-5.09406 * a + 2.61188 * a * a - 4.31805 * a * a * a);
}

double burleyShape(double diffuseAlbedo, BurleyEntry entry) {
    const double a = diffuseAlbedo;
    switch (entry) {
    case BurleyEntry::Searchlight:
        return 1.85 - a + 7 * std::pow(std::abs(a - 0.8), 3);
    case BurleyEntry::Diffuse:
        return 1.9 - a + 3.5 * (a - 0.8) * (a - 0.8);
    case BurleyEntry::SearchlightDiffuseMeanFreePath:
        return 3.5 + 100 * std::pow(a - 0.33, 4);
    }
    throw std::invalid_argument("entry is " + std::to_string(static_cast<int>(entry)) + ", must be a BurleyEntry");
}

Rgb burleyMeanFreePath(const Rgb& diffuseAlbedo, const Rgb& meanFreePath, double anisotropy) {
    requireNoFault(findFault("diffuseAlbedo", diffuseAlbedo, unitRange));
    requireNoFault(findFault("meanFreePath", meanFreePath, meanFreePathRange));
    requireNoFault(findFault("anisotropy", anisotropy, {-0.999, 0.999, ""}));
    Rgb result;
    for (int channel = 0; channel < 3; ++channel) {
        const double albedo = singleScatteringAlbedo(diffuseAlbedo[channel], anisotropy);
        result[channel] = reducedMeanFreePath(meanFreePath[channel], albedo, anisotropy) /
                          burleyShape(diffuseAlbedo[channel], BurleyEntry::Diffuse);
    }
    return result;
}

} // namespace nacre
