// How the report writes numbers and names.
#pragma once

#include "bench/results/results.hpp"

namespace nacre::bench {

/// `digits` significant ones, without an exponent or trailing zeros: 0.0123, 12.3, 12346.
std::string formatNumber(double value, int digits = 3);

/// "12.3 µs", from 10,000 µs on "12.3 ms".
std::string formatTime(double microseconds);

/// "1.2 %"
std::string formatShare(double share, int digits = 2);

/// "436,508"
std::string formatCount(std::uint64_t count);

/// "1280x720"; empty where a fit runs over all sizes.
std::string formatSize(std::uint32_t width, std::uint32_t height);

/// "0.52 ± 0.01 µs per texel"
std::string formatSlope(const Fit& fit);

/// "64 samples"
std::string formatSetting(const Measurement& measurement);

/// "a", "a and b", "a, b and c"
std::string join(const std::vector<std::string>& words);

/// The text with & < > " as entities.
std::string escapeHtml(std::string_view text);

/// "99.9 to 100.8 % (median 100.1 %)": of the frames, what the sum of their passes is.
std::string formatPassShares(const Results& results);

/// What is different, in order of first appearance.
std::vector<std::string> seriesOf(const Results& results);
std::vector<std::string> techniquesOf(const Results& results);

} // namespace nacre::bench
