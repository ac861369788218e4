// One line on standard error for work that takes longer than a second.
#pragma once

#include <string_view>
#include <thread>

namespace nacre::app {

/// Says "<what> … <seconds> s" on standard error once its life exceeds a second: on a terminal as a line that counts
/// and disappears at the end, elsewhere as one line.
class Progress {
public:
    explicit Progress(std::string_view what);

private:
    std::jthread thread_;
};

} // namespace nacre::app
