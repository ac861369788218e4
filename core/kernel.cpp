#include "nacre/kernel.hpp"

#include "fault.hpp"
#include "nacre/gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nacre {
namespace {

constexpr Range tapCountRange{3, 255, ""};
// mm; a profile of point masses alone needs no taps but the middle one.
constexpr double smallestRadius = 1e-6;

constexpr Range extentRange{0, 1e6, " mm", false};

void checkTapCount(int tapCount) {
    requireNoFault(findFault("tapCount", tapCount, tapCountRange));
    if (tapCount % 2 == 0) {
        throw std::invalid_argument("tapCount is " + std::to_string(tapCount) + ", must be odd");
    }
}

// Nodes of the integrals over one side of the line-spread, graded towards its peak.
constexpr int nodeCount = 2048;

// One half, x >= 0, of the line-spread on graded nodes, with what the tap placement integrates.
struct HalfLineSpread {
    std::vector<double> x;
    std::vector<double> density;     // cumulative tap density, 0 … 1
    std::vector<double> mass;        // cumulative mass of all channels together
    std::vector<double> firstMoment; // cumulative mass · position
};

HalfLineSpread tabulate(const Profile& profile, double radius) {
    HalfLineSpread half{{0}, {0}, {0}, {0}};
    Rgb last{0.5, 0.5, 0.5};
    for (int i = 1; i <= nodeCount; ++i) {
        const double u = double(i) / nodeCount;
        const double x = radius * u * u * u;
        const double width = x - half.x.back();
        double squares = 0;
        double cellMass = 0;
        for (int channel = 0; channel < 3; ++channel) {
            const double cumulative = profile.lineSpreadCumulative(channel, x);
            const double channelMass = std::max(0.0, cumulative - last[channel]);
            last[channel] = cumulative;
            cellMass += channelMass;
            squares += channelMass * channelMass / (width * width);
        }
        half.density.push_back(half.density.back() + std::pow(squares, 1.0 / 6) * width);
        half.mass.push_back(half.mass.back() + cellMass);
        half.firstMoment.push_back(half.firstMoment.back() + cellMass * 0.5 * (x + half.x.back()));
        half.x.push_back(x);
    }
    for (double& value : half.density) {
        value /= half.density.back();
    }
    return half;
}

// The value of `to` where the rising table `from` reaches `value`.
double lookUp(const std::vector<double>& from, const std::vector<double>& to, double value) {
    const auto upper = std::lower_bound(from.begin() + 1, from.end() - 1, value);
    const auto i = static_cast<std::size_t>(upper - from.begin());
    const double width = from[i] - from[i - 1];
    const double t = width > 0 ? std::clamp((value - from[i - 1]) / width, 0.0, 1.0) : 0;
    return to[i - 1] + t * (to[i] - to[i - 1]);
}

// Taps at `offsets` [rising] weighted by width · density(channel, offset); the widths reach half way to the neighbours.
template <typename Density> Kernel weighByWidth(const std::vector<double>& offsets, Density density) {
    Kernel kernel;
    Rgb sum{};
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const double before = i > 0 ? offsets[i] - offsets[i - 1] : 0;
        const double after = i + 1 < offsets.size() ? offsets[i + 1] - offsets[i] : 0;
        KernelTap tap{{}, offsets[i]};
        for (int channel = 0; channel < 3; ++channel) {
            tap.weight[channel] = 0.5 * (before + after) * density(channel, offsets[i]);
            sum[channel] += tap.weight[channel];
        }
        kernel.push_back(tap);
    }
    for (KernelTap& tap : kernel) {
        for (int channel = 0; channel < 3; ++channel) {
            tap.weight[channel] /= sum[channel];
        }
    }
    return kernel;
}

// Keeps `strength` of each channel and gives the rest to the tap in the middle; the sums stay.
void blendToCenter(Kernel& kernel, const Rgb& strength) {
    for (std::size_t i = 0; i < kernel.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            double& weight = kernel[i].weight[channel];
            weight = strength[channel] * weight + (i == kernel.size() / 2 ? 1 - strength[channel] : 0);
        }
    }
}

// Offsets over ±extent, closer together in the middle.
std::vector<double> quadraticOffsets(int tapCount, double extent) {
    std::vector<double> offsets;
    for (int i = 0; i < tapCount; ++i) {
        const double t = double(2 * i - (tapCount - 1)) / (tapCount - 1);
        offsets.push_back(std::copysign(extent * t * t, t));
    }
    return offsets;
}

double gaussian(double variance, double r) {
    return std::exp(-r * r / (2 * variance)) / (2 * std::numbers::pi * variance);
}

} // namespace

Kernel lineSpreadKernel(const Profile& profile, int tapCount, double radius) {
    checkTapCount(tapCount);
    if (radius == 0) {
        radius = std::max(profile.quantileRadius(defaultKernelShare), smallestRadius);
    }
    requireNoFault(findFault("radius", radius, extentRange));
    const HalfLineSpread half = tabulate(profile, radius);
    const int sideTaps = tapCount / 2;

    // The middle cell counts half on this side: cell k ends at (2k + 1) / tapCount of the tap density.
    Kernel side;
    Rgb last{0.5, 0.5, 0.5};
    double lastEnd = 0;
    for (int k = 0; k <= sideTaps; ++k) {
        const double end = lookUp(half.density, half.x, double(2 * k + 1) / tapCount);
        const double mass = lookUp(half.x, half.mass, end) - lookUp(half.x, half.mass, lastEnd);
        const double moment = lookUp(half.x, half.firstMoment, end) - lookUp(half.x, half.firstMoment, lastEnd);
        KernelTap tap{{}, k == 0 ? 0 : mass > 0 ? moment / mass : 0.5 * (lastEnd + end)};
        for (int channel = 0; channel < 3; ++channel) {
            const double cumulative = k == sideTaps ? 1 : profile.lineSpreadCumulative(channel, end);
            tap.weight[channel] = (k == 0 ? 2 : 1) * std::max(0.0, cumulative - last[channel]);
            last[channel] = cumulative;
        }
        side.push_back(tap);
        lastEnd = end;
    }

    Kernel kernel;
    for (int k = sideTaps; k > 0; --k) {
        kernel.push_back({side[static_cast<std::size_t>(k)].weight, -side[static_cast<std::size_t>(k)].offset});
    }
    kernel.insert(kernel.end(), side.begin(), side.end());
    return kernel;
}

Kernel sliceKernel(std::span<const Layer> layers, int tapRadius, double extent) {
    requireNoFault(findFault("tapRadius", tapRadius, {1, 127, ""}));
    requireNoFault(findFault("extent", extent, extentRange));
    const SumOfGaussiansProfile profile(layers);
    Rgb scattering{};
    for (const Layer& layer : profile.layers()) {
        for (int channel = 0; channel < 3 && layer.variance > 0; ++channel) {
            scattering[channel] += layer.weight[channel];
        }
    }
    Kernel kernel = weighByWidth(quadraticOffsets(2 * tapRadius + 1, extent), [&](int channel, double x) {
        // All light may stay at the centre.
        return profile.radial(channel, std::abs(x)) + std::numeric_limits<double>::min();
    });
    blendToCenter(kernel, scattering);
    return kernel;
}

Kernel jimenezKernel(int tapCount, const Rgb& strength, const Rgb& falloff) {
    checkTapCount(tapCount);
    requireNoFault(findFault("strength", strength, unitRange));
    requireNoFault(findFault("falloff", falloff, unitRange));
    // The red column of d'Eon and Luebke's skin (GPU Gems 3, table 14-1) without its first row, as in the demo.
    constexpr std::array<std::array<double, 2>, 5> terms{
        {{0.100, 0.0484}, {0.118, 0.187}, {0.113, 0.567}, {0.358, 1.99}, {0.078, 7.41}}};
    constexpr double falloffBias = 0.001; // the demo's guard against a falloff of 0
    const double extent = tapCount > 20 ? 3 : 2;
    Kernel kernel = weighByWidth(quadraticOffsets(tapCount, extent), [&](int channel, double x) {
        double sum = 0;
        for (const auto& [weight, variance] : terms) {
            sum += weight * gaussian(variance, x / (falloffBias + falloff[channel]));
        }
        return sum;
    });
    blendToCenter(kernel, strength);
    return kernel;
}

} // namespace nacre
