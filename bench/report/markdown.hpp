// Results as a section of docs/benchmark.md.
#pragma once

#include "bench/results/results.hpp"

namespace nacre::bench {

/// Machine, conclusion, slopes and (where there are any) errors, as Markdown.
std::string formatMarkdown(const Results& results);

} // namespace nacre::bench
