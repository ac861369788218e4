// What the fuzzers call: a reader of files each, with bytes in place of a file. Whatever the bytes are, an entry
// returns; what is read is sound, and what is not is refused with a FileError. Anything else ends the process.
#pragma once

#include <cstdint>
#include <span>

namespace nacre::fuzz {

struct Entry {
    const char* name; ///< of the program fuzz_NAME and of the folder of its corpus
    void (*read)(std::span<const std::uint8_t> bytes);
};

/// All of them.
std::span<const Entry> entries();

} // namespace nacre::fuzz
