#include "reference/medium.hpp"

#include "nacre/burley.hpp"
#include "nacre/presets.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace nacre::reference {
namespace {

/// A surface as white as 1 has a half space that returns everything and never ends a walk but by its surface.
constexpr double largestAlbedo = 0.99999;
constexpr double smallestWalkLength = 1e-6; ///< mm; shorter is no subsurface scattering

/// Distances within which equal shares of a channel's light leave.
std::vector<double> quantileRadii(const Profile& profile, int channel) {
    constexpr int quantiles = 64;
    std::vector<double> radii;
    for (int i = 0; i < quantiles; ++i) {
        radii.push_back(profile.inverseCdf(channel, (i + 0.5) / quantiles));
    }
    return radii;
}

/// Differences of the CDFs of a channel and of Burley's profile of d at these radii.
struct CdfDistance {
    double squares = 0; ///< their sum
    double largest = 0;
};

CdfDistance distanceFrom(const Profile& profile, int channel, std::span<const double> radii, double d) {
    const BurleyProfile burley({d, d, d});
    CdfDistance result;
    for (const double radius : radii) {
        const double difference = profile.cdf(channel, radius) - burley.cdf(channel, radius);
        result.squares += difference * difference;
        result.largest = std::max(result.largest, std::abs(difference));
    }
    return result;
}

/// The d [mm] whose Burley profile is nearest to a channel's, by golden sections over the logarithm (Kiefer 1953); 0
/// for a channel whose light leaves where it entered.
double nearestBurley(const Profile& profile, int channel, std::span<const double> radii) {
    const double rms = profile.rmsRadius(channel);
    if (!(rms > smallestWalkLength)) {
        return 0;
    }
    double low = std::log(1e-3 * rms);
    double high = std::log(rms);
    constexpr double golden = 0.6180339887498949;
    while (high - low > 1e-4) {
        const double one = high - golden * (high - low);
        const double other = low + golden * (high - low);
        if (distanceFrom(profile, channel, radii, std::exp(one)).squares <
            distanceFrom(profile, channel, radii, std::exp(other)).squares) {
            high = other;
        } else {
            low = one;
        }
    }
    return std::exp(0.5 * (low + high));
}

double indexOf(const Material& material) {
    const double root = std::sqrt(0.08 * material.specular);
    return (1 + root) / (1 - root);
}

/// The reduced albedo of the medium whose half space, by the dipole (Jensen et al. 2001), returns this share of diffuse
/// light: α′/2 · (1 + e^{−4/3·A·s}) e^{−s} with s = √(3(1 − α′)) and the boundary factor A.
double reducedAlbedoByDipole(double reflectance, double boundary) {
    double low = 0;
    double high = 1;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        const double root = std::sqrt(3 * (1 - middle));
        const double returned = 0.5 * middle * (1 + std::exp(-4.0 / 3 * boundary * root)) * std::exp(-root);
        (returned < reflectance ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

std::string presetName(std::string name) {
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return c == ' ' ? '-' : std::tolower(c); });
    return name;
}

} // namespace

const MeasuredMedium* findMedium(const Material& material) {
    const std::span<const MeasuredMedium> media = jensenMedia();
    const auto found = std::ranges::find_if(media, [&](const MeasuredMedium& measured) {
        const Material* preset = findPreset(presetName(measured.medium.name));
        return preset && !material.layers.empty() && preset->layers == material.layers;
    });
    return found == media.end() ? nullptr : &*found;
}

MediumModel::MediumModel(const Material& material, Boundary boundary, double anisotropy)
    : boundary_(boundary), anisotropy_(anisotropy), refractiveIndex_(indexOf(material)) {
    if (const MeasuredMedium* measured = findMedium(material)) {
        medium_ = measured->medium;
        refractiveIndex_ = medium_->refractiveIndex;
        for (int channel = 0; channel < 3; ++channel) {
            medium_->reducedScattering[channel] /= material.scale;
            medium_->absorption[channel] /= material.scale;
            const double extinction = medium_->reducedScattering[channel] + medium_->absorption[channel];
            length_[channel] = 1 / extinction;
            reflectance_[channel] = diffuseAlbedo(medium_->reducedScattering[channel] / extinction, 0);
        }
        if (boundary == Boundary::Fresnel) {
            reflectance_ = diffuseReflectance(*medium_);
        }
        return;
    }
    const std::unique_ptr<Profile> profile = makeProfile(material);
    for (int channel = 0; channel < 3; ++channel) {
        if (material.meanFreePath) {
            length_[channel] = (*material.meanFreePath)[channel] * material.scale;
            continue;
        }
        const std::vector<double> radii = quantileRadii(*profile, channel);
        length_[channel] = nearestBurley(*profile, channel, radii);
        if (length_[channel] > 0) {
            profileError_ = std::max(profileError_, distanceFrom(*profile, channel, radii, length_[channel]).largest);
        }
    }
}

WalkMedium MediumModel::at(const Rgb& surfaceAlbedo) const {
    WalkMedium result;
    result.anisotropy = anisotropy_;
    result.refractiveIndex = boundary_ == Boundary::Fresnel ? refractiveIndex_ : 1;
    for (int channel = 0; channel < 3; ++channel) {
        const double color = std::clamp(surfaceAlbedo[channel], 0.0, largestAlbedo);
        double reduced = 0;
        double reducedLength = 0; // ℓ′
        if (medium_) {
            reducedLength = length_[channel];
            reduced = medium_->reducedScattering[channel] * reducedLength;
            result.gain[channel] = surfaceAlbedo[channel] / std::max(reflectance_[channel], 1e-6);
        } else {
            reducedLength = length_[channel] * burleyShape(color, BurleyEntry::Diffuse);
            reduced = boundary_ == Boundary::Matched ? singleScatteringAlbedo(color, 0)
                                                     : reducedAlbedoByDipole(color, boundaryFactor(refractiveIndex_));
            result.gain[channel] = surfaceAlbedo[channel] > largestAlbedo ? surfaceAlbedo[channel] / largestAlbedo : 1;
        }
        // Similarity backwards: α′ = α(1 − g)/(1 − αg) and ℓ′ = ℓ/(1 − αg).
        reduced = std::clamp(reduced, 0.0, 1.0);
        const double albedo = reduced / (1 - anisotropy_ + reduced * anisotropy_);
        result.albedo[channel] = color > 0 ? albedo : 0;
        result.extinction[channel] = 1 / std::max(reducedLength * (1 - albedo * anisotropy_), smallestWalkLength);
    }
    return result;
}

} // namespace nacre::reference
