// How far long work is, on standard error.
#pragma once

#include <chrono>
#include <string>

namespace nacre::app {

/// On a terminal a line that is drawn anew and disappears at the end; elsewhere a line every half a minute.
class ProgressLine {
public:
    ProgressLine();
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;

    /// Whether `show` would be seen now; to be asked before a text is put together.
    bool isDue() const;
    void show(const std::string& text);

private:
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point last_;
};

/// "[#####...............]" of a share in [0, 1].
std::string progressBar(double share);

/// "45 s", "3 min 20 s", "2 h 5 min".
std::string formatDuration(double seconds);

} // namespace nacre::app
