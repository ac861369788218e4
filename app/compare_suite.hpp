// `nacre compare --suite`.
#pragma once

#include "app/suite_options.hpp"

namespace nacre::app {

/// Renders, computes references, compares, and writes the results into the output folder.
void compareSuite(const AccuracySuiteOptions& options);

} // namespace nacre::app
