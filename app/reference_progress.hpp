// How far a reference is, on standard error.
#pragma once

#include "app/progress_line.hpp"
#include "reference/reference.hpp"

namespace nacre::app {

/// A progress line with a bar, the samples, the noise and the time left.
class ReferenceProgress {
public:
    explicit ReferenceProgress(const reference::Stop& stop) : stop_(stop) {}

    void show(const reference::Progress& progress);

private:
    reference::Stop stop_;
    ProgressLine line_;
};

/// Seconds until the first condition of `stop` holds, as far as can be told; nothing when it cannot.
std::optional<double> secondsLeft(const reference::Stop& stop, const reference::Progress& progress);

} // namespace nacre::app
