// The benchmark's statistics on data whose answers are known.
#include "bench/time_statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

using namespace nacre::bench;

namespace {

std::vector<double> oneTo(int count) {
    std::vector<double> values;
    for (int i = 1; i <= count; ++i) {
        values.push_back(i);
    }
    return values;
}

// `count` times around `center` with a long upper tail, as frames have.
std::vector<double> frameTimes(std::mt19937& random, double center, int count) {
    std::lognormal_distribution<double> tail(0, 0.05);
    std::vector<double> times;
    for (int i = 0; i < count; ++i) {
        times.push_back(center * tail(random));
    }
    return times;
}

Summary around(double median, double halfWidth) {
    return {.count = 100,
            .median = median,
            .p5 = median - 2 * halfWidth,
            .p95 = median + 2 * halfWidth,
            .low = median - halfWidth,
            .high = median + halfWidth,
            .confidence = 0.95};
}

} // namespace

TEST(Summary, OfOneToHundredAndOne) {
    std::vector<double> values = oneTo(101);
    std::shuffle(values.begin(), values.end(), std::mt19937(1));
    const Summary summary = summarize(values);
    EXPECT_EQ(summary.count, 101u);
    EXPECT_DOUBLE_EQ(summary.median, 51);
    EXPECT_DOUBLE_EQ(summary.p5, 6);
    EXPECT_DOUBLE_EQ(summary.p95, 96);
}

TEST(Summary, MedianIntervalIsTheTabulatedOne) {
    // Ranks of the 95 % interval as statistical tables give them: n = 10 → 2nd and 9th, 20 → 6th and 15th,
    // 50 → 18th and 33rd, 100 → 40th and 61st.
    const struct { int count, low, high; } table[] = {{10, 2, 9}, {20, 6, 15}, {50, 18, 33}, {100, 40, 61}};
    for (const auto& row : table) {
        const Summary summary = summarize(oneTo(row.count));
        EXPECT_EQ(summary.low, row.low) << row.count;
        EXPECT_EQ(summary.high, row.high) << row.count;
        EXPECT_GE(summary.confidence, 0.95) << row.count;
    }
}

TEST(Summary, SaysHowLittleFewSamplesShow) {
    EXPECT_DOUBLE_EQ(summarize(oneTo(1)).confidence, 0);
    EXPECT_DOUBLE_EQ(summarize(oneTo(2)).confidence, 0.5);
    EXPECT_DOUBLE_EQ(summarize(oneTo(5)).confidence, 1 - 2.0 / 32);
    EXPECT_DOUBLE_EQ(summarize(oneTo(6)).confidence, 1 - 2.0 / 64);
    EXPECT_EQ(summarize(oneTo(5)).low, 1);
    EXPECT_EQ(summarize(oneTo(5)).high, 5);
}

TEST(Summary, IntervalHoldsTheTrueMedianAsOftenAsItSays) {
    std::mt19937 random(2);
    int held = 0;
    constexpr int trials = 2000;
    for (int trial = 0; trial < trials; ++trial) {
        const Summary summary = summarize(frameTimes(random, 100, 40));
        held += summary.low <= 100 && 100 <= summary.high ? 1 : 0;
    }
    EXPECT_GE(held, 0.94 * trials);
    EXPECT_LE(held, 0.99 * trials);
}

TEST(Summary, RefusesNothingAndNaN) {
    EXPECT_THROW(summarize({}), std::invalid_argument);
    EXPECT_THROW(summarize(std::vector{1.0, std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
}

TEST(Line, ThroughPointsOfALineIsThatLine) {
    const std::vector<double> x = oneTo(11);
    std::vector<double> y;
    for (const double value : x) {
        y.push_back(3 + 0.5 * value);
    }
    const Line line = fitLine(x, y);
    EXPECT_NEAR(line.slope, 0.5, 1e-12);
    EXPECT_NEAR(line.intercept, 3, 1e-12);
    EXPECT_NEAR(line.slopeLow, 0.5, 1e-6);
    EXPECT_NEAR(line.slopeHigh, 0.5, 1e-6);
    EXPECT_NEAR(line.rSquared, 1, 1e-12);
    EXPECT_NEAR(line.robustSlope, 0.5, 1e-12);
}

TEST(Line, MatchesAWorkedExample) {
    // x = 1 … 5, y = 2, 4, 5, 4, 5: slope 0.6, intercept 2.2, R² 0.6, residual sum of squares 2.4, standard error of
    // the slope √(2.4 / 3 / 10) = 0.28284, t(3, 97.5 %) = 3.18245.
    const Line line = fitLine(oneTo(5), std::vector<double>{2, 4, 5, 4, 5});
    EXPECT_NEAR(line.slope, 0.6, 1e-12);
    EXPECT_NEAR(line.intercept, 2.2, 1e-12);
    EXPECT_NEAR(line.rSquared, 0.6, 1e-12);
    EXPECT_NEAR(line.slopeHigh - line.slope, 0.900134, 1e-5);
    EXPECT_NEAR(line.slope - line.slopeLow, 0.900134, 1e-5);
}

TEST(Line, RobustSlopeIgnoresOneBadPoint) {
    const std::vector<double> x = oneTo(11);
    std::vector<double> y = x;
    y[10] = 100;
    const Line line = fitLine(x, y);
    EXPECT_GT(line.slope, 3);
    EXPECT_NEAR(line.robustSlope, 1, 1e-12);
}

TEST(Line, SlopeIntervalHoldsTheTrueSlopeAsOftenAsItSays) {
    std::mt19937 random(3);
    std::normal_distribution<double> error(0, 2);
    const std::vector<double> x = oneTo(8);
    int held = 0;
    constexpr int trials = 4000;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> y;
        for (const double value : x) {
            y.push_back(10 + 0.7 * value + error(random));
        }
        const Line line = fitLine(x, y);
        held += line.slopeLow <= 0.7 && 0.7 <= line.slopeHigh ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(held) / trials, 0.95, 0.015);
}

TEST(Line, RefusesWhatHasNoSlope) {
    const std::vector<double> two{1, 2};
    const std::vector<double> same{4, 4, 4};
    EXPECT_THROW(fitLine(two, two), std::invalid_argument);
    EXPECT_THROW(fitLine(same, oneTo(3)), std::invalid_argument);
    EXPECT_THROW(fitLine(oneTo(3), two), std::invalid_argument);
}

TEST(Line, FlatIsWhatMayBeZeroOrIsLostInTheNoise) {
    const Line noisy = fitLine(oneTo(5), std::vector<double>{10, 11, 10, 9, 10});
    EXPECT_TRUE(isFlat(noisy, 4, 9, 9.8, 0));
    const Line certain = fitLine(oneTo(5), std::vector<double>{10.0, 10.02, 10.04, 10.06, 10.08});
    EXPECT_FALSE(isFlat(certain, 4, 10, 10.08, 0.005));
    EXPECT_TRUE(isFlat(certain, 4, 10, 10.08, 0.01));
}

TEST(Line, WhatRisesAndLevelsOffIsNotFlat) {
    const std::vector<double> x{1, 2, 4, 8, 16, 32, 64, 128};
    const Line line = fitLine(x, std::vector<double>{10, 20, 30, 40, 40, 40, 40, 38});
    ASSERT_LE(line.slopeLow, 0);
    EXPECT_FALSE(isFlat(line, 127, 10, 40, 0.02));
    EXPECT_TRUE(isFlat(line, 127, 38, 40, 0.02));
}

TEST(Ratio, OfTimesThatTheClockIsTooCoarseForIsOne) {
    EXPECT_EQ(ratioOf(3, 2), 1.5);
    EXPECT_EQ(ratioOf(0, 0), 1);
    EXPECT_EQ(ratioOf(3, 0), 1);
}

TEST(NoiseFloor, IsTheDifferenceOfTheTwoOrTheirWidth) {
    EXPECT_NEAR(noiseFloor(around(100, 1), around(103, 1)), 0.03, 1e-12);
    EXPECT_NEAR(noiseFloor(around(100, 5), around(101, 1)), 0.05, 1e-12);
    EXPECT_EQ(noiseFloor(around(0, 0), around(1, 0)), 1);
}

TEST(Verdict, NeedsMoreThanNoiseAndIntervalsApart) {
    EXPECT_EQ(compareTimes(around(100, 1), around(110, 1), 0.05), Verdict::Worse);
    EXPECT_EQ(compareTimes(around(110, 1), around(100, 1), 0.05), Verdict::Better);
    EXPECT_EQ(compareTimes(around(100, 1), around(104, 1), 0.05), Verdict::Same);
    EXPECT_EQ(compareTimes(around(100, 6), around(110, 6), 0.05), Verdict::Same);
    EXPECT_EQ(comparePsnr(45, 44.5, 0.1), Verdict::Worse);
    EXPECT_EQ(comparePsnr(45, 45.5, 0.1), Verdict::Better);
    EXPECT_EQ(comparePsnr(45, 44.95, 0.1), Verdict::Same);
}

TEST(Verdict, IsUnknownWhereTooFewSamplesShowASpread) {
    const Summary six = summarize(std::vector{100.0, 101.0, 102.0, 103.0, 104.0, 105.0});
    const Summary sixLater = summarize(std::vector{200.0, 201.0, 202.0, 203.0, 204.0, 205.0});
    EXPECT_EQ(compareTimes(six, sixLater, 0.01), Verdict::Worse);
    for (const int count : {1, 2, 5}) {
        const Summary few = summarize(std::vector<double>(static_cast<std::size_t>(count), 200.0));
        EXPECT_EQ(compareTimes(six, few, 0.01), Verdict::Unknown) << count;
        EXPECT_EQ(compareTimes(few, six, 0.01), Verdict::Unknown) << count;
    }
}

TEST(Verdict, FindsTenPercentAndSeldomAnythingInNoise) {
    std::mt19937 random(4);
    int falseAlarms = 0;
    int found = 0;
    constexpr int trials = 500;
    for (int trial = 0; trial < trials; ++trial) {
        const Summary before = summarize(frameTimes(random, 100, 100));
        const double noise = noiseFloor(before, summarize(frameTimes(random, 100, 100)));
        falseAlarms += compareTimes(before, summarize(frameTimes(random, 100, 100)), noise) != Verdict::Same ? 1 : 0;
        found += compareTimes(before, summarize(frameTimes(random, 110, 100)), noise) == Verdict::Worse ? 1 : 0;
    }
    EXPECT_LE(falseAlarms, 0.01 * trials);
    EXPECT_EQ(found, trials);
}
