// How far a reference is, on standard error.
#pragma once

#include "reference/reference.hpp"

#include <chrono>
#include <string>

namespace nacre::app {

/// On a terminal a line with a bar that is drawn anew and disappears at the end; elsewhere a line every half a minute.
class ReferenceProgress {
public:
    explicit ReferenceProgress(const reference::Stop& stop);
    ~ReferenceProgress();
    ReferenceProgress(const ReferenceProgress&) = delete;

    void show(const reference::Progress& progress);

private:
    reference::Stop stop_;
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point last_;
};

/// Seconds until the first condition of `stop` holds, as far as can be told; nothing when it cannot.
std::optional<double> secondsLeft(const reference::Stop& stop, const reference::Progress& progress);

/// "45 s", "3 min 20 s", "2 h 5 min".
std::string formatDuration(double seconds);

} // namespace nacre::app
