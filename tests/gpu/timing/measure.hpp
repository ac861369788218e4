// Interleaved measurement of GPU times.
#pragma once

#include "tests/gpu/support/gpu.hpp"

namespace nacre::tests {

/// Something to time: `record` writes timestamps first … first + passes.size() around and between its passes, or none
/// where the pool is null.
struct Variant {
    std::string name;
    std::vector<std::string> passes;
    /// Called once per command buffer, before `record` is called `repeats` times.
    std::function<void()> begin;
    std::function<void(VkCommandBuffer, VkQueryPool, std::uint32_t first)> record;
};

struct Statistics {
    std::size_t samples = 0;
    double median = 0, p5 = 0, p95 = 0; ///< microseconds
};
Statistics statisticsOf(std::vector<double> samples);

struct Timing {
    std::string name;
    Statistics steady;              ///< from one repeat's start to the next one's, many in a command buffer
    Statistics single;              ///< of a lone repeat, submitted and waited for
    std::vector<Statistics> passes; ///< of repeats with timestamps between the passes, which then do not overlap
    std::vector<std::string> passNames;
};

struct MeasureSettings {
    std::uint32_t rounds = 12;       ///< every variant once a round, in turn, so that drift cancels
    std::uint32_t repeats = 20;      ///< in a row in one command buffer: the steady time
    std::uint32_t singles = 5;       ///< lone command buffers a round
    double warmUpMilliseconds = 300; ///< of every variant before the first round, so that clocks rise
};

std::vector<Timing> measure(Gpu& gpu, std::span<const Variant> variants, const MeasureSettings& settings);

/// Least-squares line through (x, y) with the 95 % confidence of its slope (Student's t).
struct Line {
    double slope = 0, intercept = 0, confidence = 0;
};
Line fitLine(std::span<const double> x, std::span<const double> y);

} // namespace nacre::tests
