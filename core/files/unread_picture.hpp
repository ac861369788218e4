// Pictures that can be done without.
#pragma once

#include "nacre/files.hpp"

namespace nacre {

/// A picture in a format that is known and not read. Whoever names it may leave it out and say so; one that is missing
/// or broken is a FileError like any other.
struct UnreadPicture : FileError {
    using FileError::FileError;
};

} // namespace nacre
