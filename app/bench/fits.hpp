// Straight lines through the series of a benchmark.
#pragma once

#include "app/bench/results.hpp"

namespace nacre::bench {

/// The variable of a series over picture sizes; its value is in Mpx.
inline constexpr const char* resolutionVariable = "resolution";

/// A line for every series, technique and picture size (over all sizes where the series varies the resolution) with at
/// least three values: of the effect's time, the frame's, and every pass's. In order of first appearance.
std::vector<Fit> fitSeries(const std::vector<Measurement>& measurements);

/// From this noise floor on a line that may be flat may be anything.
inline constexpr double tooNoisy = 0.25;

/// "flat", "grows", "falls", or "too noisy to tell".
std::string verdictOf(const Fit& fit);

/// The fits of one quantity ("effect", "frame" or a pass's name).
std::vector<const Fit*> fitsOf(const Results& results, std::string_view series, std::string_view quantity);

} // namespace nacre::bench
