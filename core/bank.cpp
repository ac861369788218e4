#include "nacre/bank.hpp"

#include "bank_kernels.hpp"
#include "half.hpp"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

// A table evaluates the profile once, on a logarithmic grid of distances; bin j reads it shifted by whole samples.
// 16 samples an octave keep the linear interpolation between them within 6e-5 of the edge response.
constexpr int samplesPerBin = 2;
constexpr int samplesPerOctave = samplesPerBin * BankTable::binsPerOctave;
// From ½ px to bankReach − ½ px: 9 octaves and the two samples around the end.
constexpr int reachSamples = 9 * samplesPerOctave + 2;
// Mixtures differ from scale to scale while the footprint (rms radius of the widest channel) is 2^leastFootprint to
// 2^largestFootprint px. Below, every channel is the identity; above, every channel that is at most 16 times narrower
// is wider than the bank.
constexpr int leastFootprint = -4;
constexpr int largestFootprint = 10;
constexpr int footprintBins = (largestFootprint - leastFootprint) * BankTable::binsPerOctave + 1;
constexpr int profileSamples = (footprintBins - 1) * samplesPerBin + reachSamples;

using Vector = std::array<double, bankSize>;

double tailOf(const Profile& profile, int channel, double x) {
    return 1 - profile.lineSpreadCumulative(channel, x);
}

// The form's right-hand side as weights on the logarithmic samples: element [m][kernel].
std::array<Vector, reachSamples> makeSampleWeights() {
    const BankForm& form = bankForm();
    std::array<Vector, reachSamples> weights{};
    for (int k = 0; k < bankReach; ++k) {
        const double position = (std::log2(k + 0.5) + 1) * samplesPerOctave;
        const int sample = static_cast<int>(position);
        const double fraction = position - sample;
        for (int kernel = 0; kernel < bankSize; ++kernel) {
            weights[sample][kernel] += (1 - fraction) * form.weightedTails[kernel][k];
            weights[sample + 1][kernel] += fraction * form.weightedTails[kernel][k];
        }
    }
    return weights;
}

// The tail at distances 2^(i / samplesPerOctave − 1) px of the finest scale.
std::vector<double> sampleTail(const Profile& profile, int channel, double finestPixelsPerMillimeter) {
    std::vector<double> samples(profileSamples);
    for (int i = 0; i < profileSamples; ++i) {
        const double pixels = std::exp2(static_cast<double>(i) / samplesPerOctave - 1);
        samples[i] = tailOf(profile, channel, pixels / finestPixelsPerMillimeter);
    }
    return samples;
}

Vector rightHandSide(std::span<const double> samples) {
    static const std::array<Vector, reachSamples> weights = makeSampleWeights();
    Vector sums{};
    for (int m = 0; m < reachSamples; ++m) {
        for (int kernel = 0; kernel < bankSize; ++kernel) {
            sums[kernel] += samples[m] * weights[m][kernel];
        }
    }
    return sums;
}

} // namespace

BankWeights projectOnBank(const Profile& profile, double pixelsPerMillimeter) {
    const BankForm& form = bankForm();
    BankWeights weights{};
    for (int channel = 0; channel < 3; ++channel) {
        Vector sums{};
        for (int k = 0; k < bankReach; ++k) {
            const double tail = tailOf(profile, channel, (k + 0.5) / pixelsPerMillimeter);
            for (int kernel = 0; kernel < bankSize; ++kernel) {
                sums[kernel] += tail * form.weightedTails[kernel][k];
            }
        }
        Vector mixture{1};
        solveMixture(sums, mixture);
        leaveOutSmallShares(sums, mixture);
        for (int kernel = 0; kernel < bankSize; ++kernel) {
            weights[kernel][channel] = mixture[kernel];
        }
    }
    return weights;
}

BankTable::BankTable(const Profile& profile) : halves_(binCount * halvesPerBin) {
    const double widest = std::max({profile.rmsRadius(0), profile.rmsRadius(1), profile.rmsRadius(2), 1e-6});
    // Bins from the scale of one pixel per millimetre on.
    const int coarsest = static_cast<int>(std::lround(binsPerOctave * (leastFootprint - std::log2(widest))));
    const double finest = std::exp2((coarsest + footprintBins - 1.0) / binsPerOctave);
    std::vector<std::uint16_t> mixtures(footprintBins * halvesPerBin);
    for (int channel = 0; channel < 3; ++channel) {
        const std::vector<double> samples = sampleTail(profile, channel, finest);
        Vector mixture{1}; // the neighbouring bin's mixture is the start of the next
        for (int bin = 0; bin < footprintBins; ++bin) {
            const int first = (footprintBins - 1 - bin) * samplesPerBin;
            const Vector sums = rightHandSide(std::span(samples).subspan(first, reachSamples));
            solveMixture(sums, mixture);
            Vector shares = mixture;
            leaveOutSmallShares(sums, shares);
            for (int kernel = 0; kernel < bankSize; ++kernel) {
                mixtures[bin * halvesPerBin + 3 * kernel + channel] = toHalf(static_cast<float>(shares[kernel]));
            }
        }
    }
    for (int bin = 0; bin < binCount; ++bin) {
        const int own = std::clamp(bin + binsPerOctave * firstOctave - coarsest, 0, footprintBins - 1);
        std::copy_n(&mixtures[own * halvesPerBin], halvesPerBin, &halves_[bin * halvesPerBin]);
    }
}

BankWeights BankTable::at(double pixelsPerMillimeter) const {
    const double position =
        std::clamp(binsPerOctave * (std::log2(pixelsPerMillimeter) - firstOctave), 0.0, binCount - 1.0);
    const int bin = std::min(static_cast<int>(position), binCount - 2);
    const double fraction = position - bin;
    BankWeights weights{};
    for (int kernel = 0; kernel < bankSize; ++kernel) {
        for (int channel = 0; channel < 3; ++channel) {
            const int half = bin * halvesPerBin + 3 * kernel + channel;
            weights[kernel][channel] =
                (1 - fraction) * fromHalf(halves_[half]) + fraction * fromHalf(halves_[half + halvesPerBin]);
        }
    }
    return weights;
}

} // namespace nacre
