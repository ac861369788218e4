// The report's conclusion: sentences that follow from the numbers, and nothing else.
#pragma once

#include "bench/results/results.hpp"

namespace nacre::bench {

/// One paragraph about the suite: what grows by how much and how surely, what is flat, what is not beaten.
std::string conclude(const Results& results);

} // namespace nacre::bench
