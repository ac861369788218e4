#include "app/reference_progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nacre::app {

namespace {

constexpr int barWidth = 20;
constexpr std::chrono::seconds lineInterval{30};

std::string bar(double share) {
    const int full = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * barWidth));
    return '[' + std::string(static_cast<std::size_t>(full), '#') +
           std::string(static_cast<std::size_t>(barWidth - full), '.') + ']';
}

} // namespace

std::string formatDuration(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(std::min(seconds, 1e12)));
    if (whole < 60) {
        return std::to_string(whole) + " s";
    }
    if (whole < 3600) {
        return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
    }
    return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

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

ReferenceProgress::ReferenceProgress(const reference::Stop& stop)
    : stop_(stop), terminal_(isatty(STDERR_FILENO) != 0), last_(std::chrono::steady_clock::now()) {}

ReferenceProgress::~ReferenceProgress() {
    if (terminal_ && shown_) {
        std::fputs("\r\033[K", stderr);
    }
}

void ReferenceProgress::show(const reference::Progress& progress) {
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ && now - last_ < lineInterval) {
        return;
    }
    last_ = now;
    shown_ = true;
    const std::optional<double> left = secondsLeft(stop_, progress);
    std::string line;
    if (left) {
        line += bar(progress.seconds / std::max(progress.seconds + *left, 1e-9)) + ' ';
    }
    line += std::to_string(static_cast<long long>(progress.sppNow)) + " samples a pixel";
    if (std::isfinite(progress.noise)) {
        char noise[32];
        std::snprintf(noise, sizeof noise, ", noise %.2g %%", 100 * progress.noise);
        line += noise;
    }
    line += left ? ", " + formatDuration(*left) + " left" : std::string();
    std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line.c_str());
    std::fflush(stderr);
}

} // namespace nacre::app
