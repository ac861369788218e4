#include "app/progress.hpp"

#include "app/terminal_text.hpp"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>

namespace nacre::app {

namespace {

void report(const std::stop_token& stop, const std::string& what) {
    std::mutex mutex;
    std::condition_variable_any changed;
    const auto stoppedWithinASecond = [&] {
        std::unique_lock lock(mutex);
        changed.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
        return stop.stop_requested();
    };
    const bool terminal = isatty(STDERR_FILENO) != 0;
    int seconds = 0;
    while (!stoppedWithinASecond()) {
        ++seconds;
        if (terminal) {
            std::fprintf(stderr, "\r%s … %d s", what.c_str(), seconds);
        } else if (seconds == 1) {
            std::fprintf(stderr, "%s …\n", what.c_str());
        }
    }
    if (terminal && seconds > 0) {
        std::fputs("\r\033[K", stderr);
    }
}

} // namespace

Progress::Progress(std::string_view what)
    : thread_([what = printable(what)](const std::stop_token& stop) { report(stop, what); }) {}

} // namespace nacre::app
