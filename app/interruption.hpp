// Ctrl-C in long work that has something to undo.
#pragma once

#include <functional>

namespace nacre::app {

/// Runs `work`, in which the first SIGINT or SIGTERM only makes the next throwIfInterrupted throw, so that destructors
/// undo what was begun; then the process ends by that signal. A second one ends it at once.
void runInterruptibly(const std::function<void()>& work);

/// Whether such a signal has come: for work that ends in its own way before it calls throwIfInterrupted.
bool isInterrupted();

/// To be called by the thread that runs the work, wherever it may end early.
void throwIfInterrupted();

} // namespace nacre::app
