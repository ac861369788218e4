// Runs a decoder in a child process, so that damaged bytes that make a library crash, hang or eat all memory are an
// error like any other. Part of target nacre::files.
#pragma once

#include "nacre/files.hpp"

#include <functional>
#include <vector>

namespace nacre {

/// What the child may use.
struct ProcessLimits {
    unsigned seconds = 3;             ///< of processor time; three times as many on the clock
    std::uint64_t bytes = 1ull << 31; ///< of memory on top of what this process has mapped
};

/// Limits for a file of this size: 3 s and 2 s a MiB; 2 GiB and 64 times the file.
ProcessLimits limitsFor(std::uint64_t fileBytes);

/// read()'s result, from a child process. An exception that read() throws is a FileError with its sentence here; a
/// child that crashes or exceeds its limits is a FileError that begins with `name`.
std::vector<std::uint8_t> runIsolated(const std::string& name, const ProcessLimits& limits,
                                      const std::function<std::vector<std::uint8_t>()>& read);

} // namespace nacre
