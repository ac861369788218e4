// The benchmark's statistics: what one configuration took, how a series of configurations grows, and whether two
// measurements differ. Everything here is distribution-free or says what it assumes; nothing touches a device.
#pragma once

#include <cstddef>
#include <span>

namespace nacre::bench {

/// Confidence asked of every interval.
inline constexpr double confidence = 0.95;

/// Repeated measurements of one quantity.
struct Summary {
    std::size_t count = 0;
    double median = 0;
    double p5 = 0;
    double p95 = 0;
    /// Confidence interval of the median from order statistics; it assumes independent samples and nothing about their
    /// distribution (Conover 1999, "Practical nonparametric statistics", 3.2).
    double low = 0;
    double high = 0;
    /// What the interval really has: at least `confidence` from six samples on; with fewer it is the whole range.
    double confidence = 0;

    bool operator==(const Summary&) const = default;
};

/// What the interval of Summary::low and Summary::high really has with so many samples.
double intervalConfidence(std::size_t count);

/// Throws std::invalid_argument when there is no sample or one is not finite.
Summary summarize(std::span<const double> samples);

/// The value below which `share` [0, 1] of the ascending samples lie, linear between neighbours (type 7 of Hyndman and
/// Fan 1996, "Sample quantiles in statistical packages").
double percentile(std::span<const double> ascending, double share);

/// One time over another; 1 where the other is 0: the clock is too coarse to tell.
double ratioOf(double time, double other);

/// The straight line through a series of measurements, and how sure its slope is.
struct Line {
    std::size_t count = 0;
    double slope = 0;
    /// Confidence interval of the slope: Student's t with count − 2 degrees of freedom on the scatter about the line.
    double slopeLow = 0;
    double slopeHigh = 0;
    double intercept = 0;
    /// [0, 1] share of the variance that the line explains; 1 when there is no variance.
    double rSquared = 0;
    /// Median of the slopes between all pairs (Theil 1950, Sen 1968): far from `slope` when one point decides it.
    double robustSlope = 0;

    bool operator==(const Line&) const = default;
};

/// Least squares. Throws std::invalid_argument unless there are at least three points, as many x as y, all finite, and
/// two different x.
Line fitLine(std::span<const double> x, std::span<const double> y);

/// How far apart, as a share, the values of a flat line may lie: its slope may be 0 where values rise and level off.
inline constexpr double flatSpread = 0.1;

/// Whether nothing says that values are not constant along x: the line's slope's interval holds 0, or it predicts a
/// change over `span` of x that is smaller than `noise` (a share) of the smallest value; and the largest value is not
/// more than `flatSpread` or `noise` above the smallest.
bool isFlat(const Line& line, double span, double smallest, double largest, double noise);

/// The difference between two medians of the same configuration that is not evidence of anything: the share by which
/// they differ, or the wider of their intervals' half widths, whichever is more. 1 when a median is 0: the clock is too
/// coarse to tell anything.
double noiseFloor(const Summary& first, const Summary& second);

enum class Verdict { Same, Better, Worse, Unknown };

/// A time against an earlier one: different only when the medians differ by more than `noise` (a share) and their
/// intervals do not overlap; unknown when an interval has not the confidence asked, as with fewer than six samples.
Verdict compareTimes(const Summary& before, const Summary& after, double noise);

/// A PSNR against an earlier one: different when it changed by more than `noise` dB.
Verdict comparePsnr(double before, double after, double noise);

} // namespace nacre::bench
