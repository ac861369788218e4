#include "app/interruption.hpp"

#include <array>
#include <csignal>

namespace nacre::app {

namespace {

volatile std::sig_atomic_t interruption = 0; // the signal's number

struct Interrupted {};

constexpr std::array handledSignals{SIGINT, SIGTERM};

void noteSignal(int signal) {
    interruption = signal;
}

/// Handles the signals while it lives, unless the caller has them ignored, as `nohup` and background jobs do.
class Handlers {
public:
    Handlers() {
        for (std::size_t i = 0; i < handledSignals.size(); ++i) {
            struct sigaction action {};
            action.sa_handler = noteSignal;
            action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
            ::sigaction(handledSignals[i], nullptr, &before_[i]);
            if (before_[i].sa_handler != SIG_IGN) {
                ::sigaction(handledSignals[i], &action, nullptr);
            }
        }
    }
    Handlers(const Handlers&) = delete;
    ~Handlers() {
        for (std::size_t i = 0; i < handledSignals.size(); ++i) {
            ::sigaction(handledSignals[i], &before_[i], nullptr);
        }
    }

private:
    std::array<struct sigaction, handledSignals.size()> before_{};
};

} // namespace

void runInterruptibly(const std::function<void()>& work) {
    try {
        const Handlers handlers;
        work();
    } catch (const Interrupted&) {
        std::raise(interruption);
    }
}

bool isInterrupted() {
    return interruption != 0;
}

void throwIfInterrupted() {
    if (isInterrupted()) {
        throw Interrupted();
    }
}

} // namespace nacre::app
