// Straight lines through the series of a benchmark.
#pragma once

#include "bench/results/results.hpp"

namespace nacre::bench {

/// The variable of a series over picture sizes; its value is in Mpx.
inline constexpr const char* resolutionVariable = "resolution";

/// A quantity of which lines are made: the passes of scatter in a frame, the sum of their medians. The effect has
/// transmit, too.
inline constexpr const char* scatterQuantity = "scatter";

/// A line for every series, technique and picture size (over all sizes where the series varies the resolution) with at
/// least three values: of the effect's time, the frame's, scatter's, and every pass's. In order of first appearance.
/// Not where errors were measured: there the value is a technique's own setting.
std::vector<Fit> fitSeries(const std::vector<Measurement>& measurements);

/// From this noise floor on a line that may be flat may be anything.
inline constexpr double tooNoisy = 0.25;

/// The verdict on what is not flat and has no certain slope.
inline constexpr const char* noLine = "no line";

/// The verdict where the noise hides the answer.
inline constexpr const char* tooNoisyToTell = "too noisy to tell";

/// "flat", "grows", "falls", `noLine` or `tooNoisyToTell`.
std::string verdictOf(const Fit& fit);

/// The fits of one quantity ("effect", "frame", scatterQuantity or a pass's name).
std::vector<const Fit*> fitsOf(const Results& results, std::string_view series, std::string_view quantity);

} // namespace nacre::bench
