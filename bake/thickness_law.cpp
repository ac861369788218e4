#include "bake/thickness_law.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace nacre::bake {
namespace {

constexpr std::size_t chordSteps = 8192;
constexpr std::size_t lengthSteps = 2048;
constexpr std::size_t cosineSteps = 512;
constexpr double leastTransmittance = 1e-4;

} // namespace

ThicknessLaw::ThicknessLaw(const Profile& profile) : reach_(profile.quantileRadius(1 - 1e-6)), chords_(chordSteps + 1) {
    for (std::size_t i = 0; i <= chordSteps; ++i) {
        const double chord = reach_ * static_cast<double>(i) / chordSteps;
        for (int channel = 0; channel < 3; ++channel) {
            chords_[i] += profile.slabTransmittance(channel, chord) / 3;
        }
    }
    // Closer where T falls steeply, near 0.
    for (std::size_t i = 0; i <= lengthSteps; ++i) {
        const double share = static_cast<double>(i) / lengthSteps;
        const double length = reach_ * share * share;
        const double slab = slabMean(length);
        lengths_.push_back(length);
        slabs_.push_back(slab);
        if (slab < leastTransmittance) {
            break;
        }
    }
}

double ThicknessLaw::transmittance(double chord) const {
    if (reach_ == 0) {
        return 1 / chord;
    }
    const double place = chord / reach_ * chordSteps;
    if (!(place < chordSteps)) {
        return 0;
    }
    const auto cell = static_cast<std::size_t>(place);
    return std::lerp(chords_[cell], chords_[cell + 1], place - static_cast<double>(cell));
}

double ThicknessLaw::slabMean(double thickness) const {
    if (reach_ == 0) {
        return 2 / (3 * thickness);
    }
    double sum = 0;
    for (std::size_t i = 0; i < cosineSteps; ++i) {
        const double cosine = (static_cast<double>(i) + 0.5) / cosineSteps;
        sum += 2 * cosine * transmittance(thickness / cosine);
    }
    return sum / cosineSteps;
}

double ThicknessLaw::thickness(double mean) const {
    if (reach_ == 0) {
        return 2 / (3 * mean);
    }
    const auto below = std::ranges::lower_bound(slabs_, mean, std::greater<>());
    if (below == slabs_.begin()) {
        return lengths_.front();
    }
    if (below == slabs_.end()) {
        return lengths_.back();
    }
    const auto i = static_cast<std::size_t>(below - slabs_.begin());
    return std::lerp(lengths_[i - 1], lengths_[i], (slabs_[i - 1] - mean) / (slabs_[i - 1] - slabs_[i]));
}

double ThicknessLaw::longest() const {
    return reach_ == 0 ? std::numeric_limits<double>::infinity() : lengths_.back();
}

} // namespace nacre::bake
