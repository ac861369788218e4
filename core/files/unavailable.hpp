// What a file names and can be done without.
#pragma once

#include "nacre/files.hpp"

namespace nacre {

/// A file that does not exist, or a picture in a format that is known and not read. Whoever names it may leave it out
/// and say so; a file that is broken is a FileError like any other.
struct Unavailable : FileError {
    using FileError::FileError;
};

} // namespace nacre
