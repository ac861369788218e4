// The report's tables as HTML.
#pragma once

#include "bench/results/results.hpp"

namespace nacre::bench {

/// Slopes of a series: of the effect and the frame, all techniques and sizes. Empty when nothing was fitted.
std::string slopeTable(const Results& results, const std::string& series);

/// The same for every pass. Empty when nothing was fitted.
std::string passSlopeTable(const Results& results, const std::string& series);

/// Every measurement of a series.
std::string measurementTable(const Results& results, const std::string& series);

/// The passes of the series' last value at its largest picture, one column a technique.
std::string passTable(const Results& results, const std::string& series);

/// Time, error and whether anything beats it, for the measurements that have an error.
std::string paretoTable(const std::vector<const Measurement*>& group);

std::string noiseTable(const Results& results);

/// Device memory by technique and size.
std::string memoryTable(const Results& results);

/// What it was measured on, and how.
std::string machineTable(const Results& results);

} // namespace nacre::bench
