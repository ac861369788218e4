#include "bench/time_statistics.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace nacre::bench {

namespace {

void checkFinite(std::span<const double> values, const char* what) {
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) {
        throw std::invalid_argument(std::string(what) + " has a value that is not finite");
    }
}

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return percentile(values, 0.5);
}

// How many samples to leave out at either end: the interval between the next ones then holds the median unless fewer
// than that many of the fair coin's `count` throws, plus one, fall on one side.
std::size_t samplesOutsideInterval(std::size_t count) {
    const boost::math::binomial coin(static_cast<double>(count), 0.5);
    std::size_t outside = 0;
    while (2 * (outside + 1) < count && 2 * cdf(coin, static_cast<double>(outside + 1)) <= 1 - confidence) {
        ++outside;
    }
    return outside;
}

double robustSlope(std::span<const double> x, std::span<const double> y) {
    std::vector<double> slopes;
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t j = i + 1; j < x.size(); ++j) {
            if (x[i] != x[j]) {
                slopes.push_back((y[j] - y[i]) / (x[j] - x[i]));
            }
        }
    }
    return medianOf(std::move(slopes));
}

double mean(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

// Half the interval of the median, as a share of it.
double halfWidth(const Summary& summary) {
    return std::max(summary.high - summary.median, summary.median - summary.low) / summary.median;
}

} // namespace

double percentile(std::span<const double> ascending, double share) {
    const double position = share * static_cast<double>(ascending.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, ascending.size() - 1);
    const double fraction = position - static_cast<double>(below);
    return ascending[below] + fraction * (ascending[above] - ascending[below]);
}

double ratioOf(double time, double other) {
    return other > 0 ? time / other : 1;
}

double intervalConfidence(std::size_t count) {
    const boost::math::binomial coin(static_cast<double>(count), 0.5);
    return std::max(0.0, 1 - 2 * cdf(coin, static_cast<double>(samplesOutsideInterval(count))));
}

Summary summarize(std::span<const double> samples) {
    if (samples.empty()) {
        throw std::invalid_argument("there is no sample to summarise");
    }
    checkFinite(samples, "a measurement");
    std::vector<double> ascending(samples.begin(), samples.end());
    std::sort(ascending.begin(), ascending.end());
    const std::size_t count = ascending.size();
    const std::size_t outside = samplesOutsideInterval(count);
    return {.count = count,
            .median = percentile(ascending, 0.5),
            .p5 = percentile(ascending, 0.05),
            .p95 = percentile(ascending, 0.95),
            .low = ascending[outside],
            .high = ascending[count - 1 - outside],
            .confidence = intervalConfidence(count)};
}

Line fitLine(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size() || x.size() < 3) {
        throw std::invalid_argument("a line needs at least three points, each with an x and a y");
    }
    checkFinite(x, "a line's x");
    checkFinite(y, "a line's y");
    const double meanX = mean(x);
    const double meanY = mean(y);
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - meanX) * (x[i] - meanX);
        xy += (x[i] - meanX) * (y[i] - meanY);
        yy += (y[i] - meanY) * (y[i] - meanY);
    }
    if (!(xx > 0)) {
        throw std::invalid_argument("a line needs two different x");
    }
    const double slope = xy / xx;
    const double residual = std::max(0.0, yy - slope * xy);
    const auto freedom = static_cast<double>(x.size() - 2);
    const double factor = quantile(boost::math::students_t(freedom), 0.5 + confidence / 2);
    const double margin = factor * std::sqrt(residual / freedom / xx);
    return {.count = x.size(),
            .slope = slope,
            .slopeLow = slope - margin,
            .slopeHigh = slope + margin,
            .intercept = meanY - slope * meanX,
            .rSquared = yy > 0 ? 1 - residual / yy : 1,
            .robustSlope = robustSlope(x, y)};
}

bool isFlat(const Line& line, double span, double smallest, double largest, double noise) {
    const bool holdsZero = line.slopeLow <= 0 && line.slopeHigh >= 0;
    const bool staysNear = largest <= smallest * (1 + std::max(noise, flatSpread));
    return staysNear && (holdsZero || std::abs(line.slope * span) < noise * smallest);
}

double noiseFloor(const Summary& first, const Summary& second) {
    const double smaller = std::min(first.median, second.median);
    if (!(smaller > 0)) {
        return 1;
    }
    const double difference = std::abs(first.median - second.median) / smaller;
    return std::max({difference, halfWidth(first), halfWidth(second)});
}

Verdict compareTimes(const Summary& before, const Summary& after, double noise) {
    if (std::min(before.confidence, after.confidence) < confidence) {
        return Verdict::Unknown;
    }
    if (after.median > before.median * (1 + noise) && after.low > before.high) {
        return Verdict::Worse;
    }
    if (before.median > after.median * (1 + noise) && before.low > after.high) {
        return Verdict::Better;
    }
    return Verdict::Same;
}

Verdict comparePsnr(double before, double after, double noise) {
    if (std::abs(after - before) <= noise) {
        return Verdict::Same;
    }
    return after < before ? Verdict::Worse : Verdict::Better;
}

} // namespace nacre::bench
