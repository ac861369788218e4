// A reference on disk while it is computed: every sum in full precision, so that it can be resumed and its parts merged
// without a bit of difference.
#pragma once

#include "reference/film.hpp"
#include "trace/work_file.hpp"

namespace nacre::reference {

struct Checkpoint {
    trace::Identity identity; ///< Reference::identity
    Part part;
    Film film;
};

/// Writes it whole or not at all. Throws FileError.
void saveCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Throws FileError naming the file and what is wrong with it.
Checkpoint loadCheckpoint(const std::filesystem::path& file);

/// One film of all parts. Throws FileError unless they are the parts 1 to N of one reference, each once.
Checkpoint merge(const std::vector<std::filesystem::path>& files);

} // namespace nacre::reference
