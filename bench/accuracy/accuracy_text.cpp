#include "bench/accuracy/accuracy_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nacre::bench {
namespace {

template <typename... Values> std::string format(const char* pattern, Values... values) {
    std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, pattern, values...)), '\0');
    std::snprintf(text.data(), text.size() + 1, pattern, values...);
    return text;
}

std::string describe(const AccuracyFigures& figures) {
    return format("%7s dB  %6s %6s %6s %%", formatPsnr(figures).c_str(), formatEnergy(figures.energy[0]).c_str(),
                  formatEnergy(figures.energy[1]).c_str(), formatEnergy(figures.energy[2]).c_str());
}

} // namespace

std::string formatDecibels(double psnr) {
    return std::isinf(psnr) ? "inf" : format("%.1f", psnr);
}

std::string formatPsnr(const AccuracyFigures& figures) {
    return (figures.isBound ? "> " : "") + formatDecibels(figures.psnrWithoutNoise);
}

std::string formatEnergy(double ratio) {
    return std::isfinite(ratio) ? format("%+.1f", 100 * (ratio - 1)) : "-";
}

std::string formatShort(double value) {
    return format("%.4f", value);
}

std::string formatWhole(double value) {
    return format("%.0f", value);
}

std::string formatAccuracyText(const AccuracyViewResult& view) {
    std::string text = view.name + ": " + view.what + '\n';
    for (const AccuracyReference& reference : view.references) {
        text += format("  %-15s PSNR       energy R G B               FLIP     thin parts: PSNR, energy\n",
                       reference.method.c_str());
        for (const AccuracyCell& cell : view.cells) {
            if (cell.reference == reference.method) {
                text += format("  %-13s", cell.technique.c_str()) + describe(cell.whole) +
                        format("   %.4f", cell.flip) + (cell.thin ? "  " + describe(*cell.thin) : "") + '\n';
            }
        }
        text += format("  (reference: %.0f samples a pixel, noise %.2g %% or %s dB)\n", reference.samples,
                       100 * reference.noise, formatDecibels(reference.noisePsnr).c_str());
    }
    return text;
}

} // namespace nacre::bench
