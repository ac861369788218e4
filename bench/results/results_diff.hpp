// What got slower or less accurate between two runs of a benchmark.
#pragma once

#include "bench/results/results.hpp"

namespace nacre::bench {

/// A PSNR that changed by less than this is the same, dB: what other rounding in the sums may do to it.
inline constexpr double psnrNoise = 0.1;

/// One quantity of one configuration, in both runs.
struct Change {
    std::string id;
    std::string quantity; ///< "frame", "effect" or "PSNR"
    std::string unit;     ///< "µs" or "dB"
    double before = 0;
    double after = 0;
    double noise = 0; ///< what is no difference: a share of a time, dB of a PSNR
    Verdict verdict = Verdict::Same;
};

struct Comparison {
    std::vector<Change> changes;      ///< all, the same ones included
    std::vector<std::string> removed; ///< ids that only the earlier run has
    std::vector<std::string> added;   ///< ids that only the later run has
    std::string caution;              ///< why times may not be comparable, one sentence; empty when they are

    /// Whether anything got slower or less accurate beyond noise.
    bool regressed() const;
};

/// Throws std::invalid_argument when the runs have no configuration in common.
Comparison compare(const Results& before, const Results& after);

/// The comparison as lines of text: what got worse, what got better, how many cannot be told, and how many stayed the
/// same.
std::string formatComparison(const Comparison& comparison);

} // namespace nacre::bench
