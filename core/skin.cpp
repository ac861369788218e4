#include "nacre/skin.hpp"

#include "fault.hpp"

#include <cmath>
#include <numbers>

namespace nacre {
namespace {

// Whole blood's haemoglobin, and what turns its molar extinction into absorption (Prahl 1999).
constexpr double haemoglobinGramsPerLitre = 150;
constexpr double haemoglobinGramsPerMole = 64500;

// Prahl's table at skinWavelengths, 1/(cm·mol/l).
constexpr Rgb oxygenatedExtinction{1506, 43016, 44480};
constexpr Rgb deoxygenatedExtinction{9443.6, 53412, 23388.8};

// Hale and Querry's k at skinWavelengths, between their 600 and 625 nm and their 450 and 475 nm by straight lines.
constexpr Rgb waterExtinctionCoefficient{1.21e-8, 1.96e-9, 9.86e-10};

double bloodAbsorption(double molarExtinction) {
    constexpr double perMillimetre = 0.1; // of 1/cm
    return perMillimetre * std::numbers::ln10 * molarExtinction * haemoglobinGramsPerLitre / haemoglobinGramsPerMole;
}

} // namespace

std::string findFault(const SkinContent& content) {
    const struct {
        const char* field;
        double value;
    } shares[] = {{"melanin", content.melanin},
                  {"eumelanin", content.eumelanin},
                  {"haemoglobin", content.haemoglobin},
                  {"oxygenation", content.oxygenation},
                  {"water", content.water},
                  {"melanin + haemoglobin", content.melanin + content.haemoglobin}};
    for (const auto& share : shares) {
        if (auto fault = findFault(share.field, share.value, unitRange); !fault.empty()) {
            return fault;
        }
    }
    return {};
}

Rgb skinAbsorption(const SkinContent& content) {
    requireNoFault(findFault(content));
    Rgb result;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double wavelength = skinWavelengths[channel];
        const double melanosome =
            std::lerp(2.9e14 * std::pow(wavelength, -4.75), 6.6e10 * std::pow(wavelength, -3.33), content.eumelanin);
        const double blood = std::lerp(bloodAbsorption(deoxygenatedExtinction[channel]),
                                       bloodAbsorption(oxygenatedExtinction[channel]), content.oxygenation);
        const double millimetres = wavelength * 1e-6;
        const double water = 4 * std::numbers::pi * waterExtinctionCoefficient[channel] / millimetres;
        const double baseline = 0.0244 + 8.53 * std::exp(-(wavelength - 154) / 66.2);
        result[channel] = content.melanin * melanosome + content.haemoglobin * blood + content.water * water +
                          (1 - content.melanin - content.haemoglobin) * baseline;
    }
    return result;
}

Rgb skinReducedScattering() {
    Rgb result;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        result[channel] = 4.6 * std::pow(skinWavelengths[channel] / 500, -1.421);
    }
    return result;
}

} // namespace nacre
