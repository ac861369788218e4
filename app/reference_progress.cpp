#include "app/reference_progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nacre::app {

std::optional<double> secondsLeft(const reference::Stop& stop, const reference::Progress& progress) {
    std::optional<double> left;
    const auto add = [&](double seconds) { left = std::min(left.value_or(seconds), std::max(seconds, 0.0)); };
    if (stop.seconds) {
        add(*stop.seconds - progress.seconds);
    }
    if (progress.sppPerSecond > 0) {
        if (stop.spp) {
            add((*stop.spp - progress.sppNow) / progress.sppPerSecond);
        }
        if (stop.noise && std::isfinite(progress.noise)) {
            // The standard error falls with the square root of the samples.
            const double ratio = progress.noise / *stop.noise;
            add((progress.spp * ratio * ratio - progress.sppNow) / progress.sppPerSecond);
        }
    }
    return left;
}

void ReferenceProgress::show(const reference::Progress& progress) {
    if (!line_.isDue()) {
        return;
    }
    const std::optional<double> left = secondsLeft(stop_, progress);
    std::string line;
    if (left) {
        line += progressBar(progress.seconds / std::max(progress.seconds + *left, 1e-9)) + ' ';
    }
    line += std::to_string(static_cast<long long>(progress.sppNow)) + " samples a pixel";
    if (std::isfinite(progress.noise)) {
        char noise[32];
        std::snprintf(noise, sizeof noise, ", noise %.2g %%", 100 * progress.noise);
        line += noise;
    }
    line += left ? ", " + formatDuration(*left) + " left" : std::string();
    line_.show(line);
}

} // namespace nacre::app
