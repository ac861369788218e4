// The report's plots as data; report/report.js draws them.
#pragma once

#include "bench/results/results.hpp"

namespace nacre::bench {

struct ChartPoint {
    double x = 0;
    double y = 0;
    double low = 0; ///< whiskers; both equal to y: none
    double high = 0;
    std::string label; ///< shown beside the point; empty = none
};

/// What a set of points is, which decides how it looks.
enum class ChartSetKind {
    Measured, ///< a technique, in its own colour
    Floor,    ///< the copy pass
    Thesis,   ///< what the thesis states
    Frontier, ///< points that nothing beats in both respects, joined by a line
};

struct ChartSet {
    std::string name;
    ChartSetKind kind = ChartSetKind::Measured;
    std::size_t color = 0; ///< Measured: index of the technique
    bool joined = true;    ///< by a line
    std::vector<ChartPoint> points;
};

struct Chart {
    std::string title;
    std::string xLabel;
    std::string yLabel;
    bool logX = false;
    bool logY = false;
    std::vector<ChartSet> sets;
};

/// What the report says about a series, and how it plots it.
struct SeriesText {
    const char* series;
    const char* title;
    const char* text;
    bool logX;
};

/// The text of a series; one that is not known has its name for a title.
SeriesText describeSeries(std::string_view series);

/// Time against the series' variable: a plot for each picture size, and for the thesis's second experiment another that
/// holds its stated line.
std::vector<Chart> chartsOfSeries(const Results& results, const std::string& series);

/// The measurements that have an error, one group for each series: one view, picture size and footprint.
std::vector<std::vector<const Measurement*>> paretoGroups(const Results& results);

/// "gallery, front, 1920x1080, footprint 12 px"
std::string describeParetoGroup(const std::vector<const Measurement*>& group);

/// Every setting of one picture size over all views and footprints: geometric mean of the times, mean of the errors.
using ParetoMean = std::vector<Measurement>;
std::vector<ParetoMean> paretoMeans(const Results& results);
std::vector<const Measurement*> pointersTo(const ParetoMean& mean);

/// PSNR against time.
Chart paretoChart(const Results& results, const std::vector<const Measurement*>& group);

/// Those of a group that no other beats in both time and PSNR, by time.
std::vector<const Measurement*> paretoFrontier(const std::vector<const Measurement*>& group);

} // namespace nacre::bench
