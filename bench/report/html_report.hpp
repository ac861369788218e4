// report.html: one file with everything in it, that opens without a network and prints.
#pragma once

#include "bench/results/results.hpp"

namespace nacre::bench {

/// The report of these results; the pictures they name are read from `folder`. Throws FileError (nacre/files.hpp)
/// naming the picture that cannot be read.
std::string formatReport(const Results& results, const std::filesystem::path& folder);

} // namespace nacre::bench
