// Accuracy results as the tables of docs/accuracy.md.
#pragma once

#include "bench/accuracy/accuracy_results.hpp"

namespace nacre::bench {

/// For each reference: PSNR and energy of all techniques by view, and the default technique's figures in full.
std::string formatAccuracyMarkdown(const AccuracyResults& results);

} // namespace nacre::bench
