// The images that `nacre compare` looks at, and which of their pixels count.
#pragma once

#include "app/compare_options.hpp"
#include "image/comparison.hpp"

namespace nacre::app {

struct CompareInputs {
    Image test;      ///< R, G, B of one encoding with the reference's
    Image reference; ///< R, G, B
    ComparisonSettings settings;
    std::vector<std::string> materials; ///< ids and names of those that count, e.g. "2 (skin)"
};

/// Reads all files. Throws an exception with one sentence that names the file, and the channel or the sizes.
CompareInputs readInputs(const CompareOptions& options);

} // namespace nacre::app
