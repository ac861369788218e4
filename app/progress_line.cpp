#include "app/progress_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nacre::app {

namespace {

constexpr int barWidth = 20;
constexpr std::chrono::seconds lineInterval{30};

} // namespace

std::string progressBar(double share) {
    const int full = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * barWidth));
    return '[' + std::string(static_cast<std::size_t>(full), '#') +
           std::string(static_cast<std::size_t>(barWidth - full), '.') + ']';
}

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

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0), last_(std::chrono::steady_clock::now()) {}

ProgressLine::~ProgressLine() {
    if (terminal_ && shown_) {
        std::fputs("\r\033[K", stderr);
    }
}

bool ProgressLine::isDue() const {
    return terminal_ || std::chrono::steady_clock::now() - last_ >= lineInterval;
}

void ProgressLine::show(const std::string& text) {
    if (!isDue()) {
        return;
    }
    last_ = std::chrono::steady_clock::now();
    shown_ = true;
    std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", text.c_str());
    std::fflush(stderr);
}

} // namespace nacre::app
