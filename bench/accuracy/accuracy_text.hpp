// Accuracy results as text for a terminal.
#pragma once

#include "bench/accuracy/accuracy_results.hpp"

namespace nacre::bench {

/// One view: its references, and a row for each technique.
std::string formatAccuracyText(const AccuracyViewResult& view);

/// "47.5", "∞"
std::string formatDecibels(double psnr);
/// AccuracyFigures::psnrWithoutNoise: "47.5", and "> 47.5" where it is a bound
std::string formatPsnr(const AccuracyFigures& figures);
/// "-1.5": how far it is from 1, in %
std::string formatEnergy(double ratio);
/// "0.0123"
std::string formatShort(double value);
/// "47"
std::string formatWhole(double value);

} // namespace nacre::bench
