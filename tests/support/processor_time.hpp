#pragma once

#include <sys/resource.h>

namespace nacre::tests {

/// [0, inf) s Processor time of this process and of its children that have ended. Tests bound it in place of what a
/// clock says, which depends on what runs beside them.
inline double processorSeconds() {
    double seconds = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        ::getrusage(who, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime}) {
            seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
        }
    }
    return seconds;
}

} // namespace nacre::tests
