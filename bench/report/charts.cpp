#include "bench/report/charts.hpp"

#include "bench/report/report_text.hpp"
#include "bench/results/series_fits.hpp"
#include "bench/suites/thesis_constants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace nacre::bench {
namespace {

constexpr SeriesText seriesTexts[] = {
    {"experiment 1, front", "Experiment 1, front-lit (thesis, figure 4.3)",
     "Both effects together against the number of layers; kernel of 11 weights. The thesis's text states no times for "
     "this figure. The thesis's translucency adds up the layers in every pixel; the others' reads them, added up when "
     "the "
     "material is set, from a table over thickness.",
     false},
    {"experiment 1, back", "Experiment 1, back-lit (thesis, figure 4.3)",
     "Both effects together against the number of layers, the lights behind the bodies.", false},
    {"experiment 2", "Experiment 2: front-lit scattering (thesis, figure 4.5)",
     "Scattering alone against the radius of the blur. The thesis states its slope at both sizes and its last value at "
     "1920x1080; techniques whose radius is in millimetres get the width that this radius stands for.",
     false},
    {"experiment 3", "Experiment 3: back-lit translucency (thesis, figure 4.7)",
     "Translucency alone against the number of layers. The thesis's text states no times for this figure, but that its "
     "shader adds up the layers of every pixel, as `thesis` does here; `slab` reads them, added up when the material "
     "is "
     "set, from a table over thickness.",
     false},
    {"resolution", "Resolution", "The same view at growing picture sizes.", false},
    {"coverage", "Coverage", "The share of the picture that has a subsurface material.", false},
    {"footprint", "Footprint", "How far light travels on the picture: the rms radius of the widest channel.", true},
    {"materials", "Materials", "Different materials in the same picture.", true},
    {"layers", "Layers", "Layers of every material in the picture.", false},
    {"lights", "Lights", "Spot lights with shadow maps, each lighting the whole body.", false},
    {"triangles", "Triangles", "Triangles of the body. Only the frame's own passes see them.", true},
};

const SeriesText paretoText{
    "pareto", "Error against time",
    "Up is closer to the brute-force reference, left is faster. Numbers are settings: radius in "
    "texels (thesis), samples (burley), and for techniques without a setting of their own the "
    "share of the picture's pixels that are rendered, in %, enlarged afterwards.",
    false};

// From this on a plot is in milliseconds, µs.
constexpr double millisecondsFrom = 10'000;

std::string axis(const std::string& variable, const std::string& unit) {
    return unit.empty() ? variable : variable + " (" + unit + ")";
}

ChartPoint point(const Measurement& measurement, const Summary& time) {
    return {measurement.value, time.median, time.low, time.high, {}};
}

// The copy pass, which is the same for all techniques: the median of what each of them found.
ChartSet floorOf(const std::vector<const Measurement*>& measurements) {
    std::map<double, std::vector<double>> times;
    for (const Measurement* measurement : measurements) {
        times[measurement->value].push_back(measurement->copy.median);
    }
    ChartSet set{.name = "copy pass", .kind = ChartSetKind::Floor};
    for (auto& [value, medians] : times) {
        std::sort(medians.begin(), medians.end());
        const double time = percentile(medians, 0.5);
        set.points.push_back({value, time, time, time, {}});
    }
    return set;
}

void useReadableUnit(Chart& chart) {
    double largest = 0;
    for (const ChartSet& set : chart.sets) {
        for (const ChartPoint& point : set.points) {
            largest = std::max(largest, point.y);
        }
    }
    const bool milliseconds = largest >= millisecondsFrom;
    chart.yLabel = milliseconds ? "time of the effect (ms)" : "time of the effect (µs)";
    for (ChartSet& set : chart.sets) {
        for (ChartPoint& point : set.points) {
            const double factor = milliseconds ? 1e-3 : 1;
            point.y *= factor;
            point.low *= factor;
            point.high *= factor;
        }
    }
}

Chart chartOf(const Results& results, const std::vector<const Measurement*>& measurements, std::string title) {
    const Measurement& any = *measurements.front();
    Chart chart{
        .title = std::move(title), .xLabel = axis(any.variable, any.unit), .logX = describeSeries(any.series).logX};
    const std::vector<std::string> techniques = techniquesOf(results);
    for (std::size_t index = 0; index < techniques.size(); ++index) {
        ChartSet set{.name = techniques[index], .color = index};
        for (const Measurement* measurement : measurements) {
            if (measurement->technique == techniques[index]) {
                set.points.push_back(point(*measurement, measurement->effect));
            }
        }
        if (!set.points.empty()) {
            chart.sets.push_back(std::move(set));
        }
    }
    chart.sets.push_back(floorOf(measurements));
    return chart;
}

// The line the thesis states for 1920x1080: 1.0 ms a texel, close to 18 ms at its last radius.
ChartSet thesisRadiusLine(const std::vector<const Measurement*>& measurements) {
    ChartSet set{.name = "stated by the thesis (1920x1080, GeForce GT 555M)", .kind = ChartSetKind::Thesis};
    std::map<double, double> line;
    for (const Measurement* measurement : measurements) {
        line[measurement->value] =
            thesis::largestRadiusTime1080 + (measurement->value - thesis::largestRadius) * thesis::radiusSlope1080;
    }
    for (const auto& [radius, time] : line) {
        set.points.push_back({radius, time, time, time, {}});
    }
    return set;
}

std::vector<const Measurement*> measurementsOf(const Results& results, const std::string& series) {
    std::vector<const Measurement*> measurements;
    for (const Measurement& measurement : results.measurements) {
        if (measurement.series == series) {
            measurements.push_back(&measurement);
        }
    }
    return measurements;
}

// Groups whose measurements have equal keys, in order of first appearance.
template <typename KeyOf>
std::vector<std::vector<const Measurement*>> grouped(const std::vector<const Measurement*>& measurements, KeyOf keyOf) {
    std::vector<std::vector<const Measurement*>> groups;
    for (const Measurement* measurement : measurements) {
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& candidate) {
            return keyOf(*candidate.front()) == keyOf(*measurement);
        });
        (group == groups.end() ? groups.emplace_back() : *group).push_back(measurement);
    }
    return groups;
}

// The one with the most pixels: settings that lower the resolution have fewer.
const Measurement& largestOf(const std::vector<const Measurement*>& measurements) {
    return **std::max_element(measurements.begin(), measurements.end(), [](const Measurement* a, const Measurement* b) {
        return std::uint64_t{a->width} * a->height < std::uint64_t{b->width} * b->height;
    });
}

double geometricMean(const std::vector<const Measurement*>& measurements, double Summary::*member) {
    double sum = 0;
    for (const Measurement* measurement : measurements) {
        sum += std::log(measurement->effect.*member);
    }
    return std::exp(sum / static_cast<double>(measurements.size()));
}

double mean(const std::vector<const Measurement*>& measurements, double ImageError::*member) {
    double sum = 0;
    for (const Measurement* measurement : measurements) {
        sum += *measurement->error.*member;
    }
    return sum / static_cast<double>(measurements.size());
}

// One setting over all of `measurements`.
Measurement average(const std::vector<const Measurement*>& measurements) {
    Measurement result = *measurements.front();
    result.view = "mean of " + std::to_string(measurements.size()) + " pictures";
    result.footprint = 0;
    for (double Summary::*member : {&Summary::median, &Summary::p5, &Summary::p95, &Summary::low, &Summary::high}) {
        result.effect.*member = geometricMean(measurements, member);
    }
    for (double ImageError::*member : {&ImageError::psnr, &ImageError::relMse, &ImageError::energyRatio}) {
        *result.error.*member = mean(measurements, member);
    }
    for (const Measurement* measurement : measurements) {
        result.noise = std::max(result.noise, measurement->noise);
    }
    return result;
}

} // namespace

SeriesText describeSeries(std::string_view series) {
    for (const SeriesText& text : seriesTexts) {
        if (series == text.series) {
            return text;
        }
    }
    return series.starts_with(paretoText.series) ? paretoText : SeriesText{"", "Further measurements", "", false};
}

std::vector<Chart> chartsOfSeries(const Results& results, const std::string& series) {
    const std::vector<const Measurement*> all = measurementsOf(results, series);
    const bool overSizes = !all.empty() && all.front()->variable == resolutionVariable;
    const auto groups = grouped(all, [overSizes](const Measurement& measurement) {
        return overSizes ? std::pair{0u, 0u} : std::pair{measurement.width, measurement.height};
    });
    const auto largest = std::max_element(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
        return a.front()->height < b.front()->height;
    });
    std::vector<Chart> charts;
    for (const auto& group : groups) {
        const Measurement& any = *group.front();
        charts.push_back(chartOf(results, group, overSizes ? "all sizes" : formatSize(any.width, any.height)));
        if (series == "experiment 2" && group == *largest) {
            Chart& withThesis = charts.emplace_back(charts.back());
            withThesis.title += ", with the thesis's line, logarithmic";
            withThesis.logY = true;
            withThesis.sets.push_back(thesisRadiusLine(group));
        }
    }
    for (Chart& chart : charts) {
        useReadableUnit(chart);
    }
    return charts;
}

std::vector<std::vector<const Measurement*>> paretoGroups(const Results& results) {
    std::vector<const Measurement*> withError;
    for (const Measurement& measurement : results.measurements) {
        if (measurement.error) {
            withError.push_back(&measurement);
        }
    }
    return grouped(withError, [](const Measurement& measurement) { return measurement.series; });
}

std::string describeParetoGroup(const std::vector<const Measurement*>& group) {
    const Measurement& largest = largestOf(group);
    const std::string footprint = largest.footprint > 0 ? ", footprint " + formatNumber(largest.footprint) + " px" : "";
    return largest.view + ", " + formatSize(largest.width, largest.height) + footprint;
}

Chart paretoChart(const Results& results, const std::vector<const Measurement*>& group) {
    Chart chart = chartOf(results, group, describeParetoGroup(group));
    chart.sets.pop_back();
    chart.logX = true;
    const auto place = [](ChartPoint& point, const Measurement& measurement) {
        const double psnr = measurement.error->psnr;
        point = {measurement.effect.median, psnr, psnr, psnr, formatNumber(measurement.value)};
    };
    for (ChartSet& set : chart.sets) {
        std::size_t next = 0;
        for (const Measurement* measurement : group) {
            if (measurement->technique == set.name) {
                place(set.points[next++], *measurement);
            }
        }
    }
    ChartSet frontier{.name = "not beaten in both", .kind = ChartSetKind::Frontier};
    for (const Measurement* measurement : paretoFrontier(group)) {
        place(frontier.points.emplace_back(), *measurement);
        frontier.points.back().label.clear();
    }
    chart.sets.push_back(std::move(frontier));
    chart.xLabel = "time of the effect (µs)";
    chart.yLabel = "PSNR against brute (dB)";
    return chart;
}

std::vector<ParetoMean> paretoMeans(const Results& results) {
    // By the size of the group's picture, then by setting.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<const Measurement*>> sizes;
    for (const auto& group : paretoGroups(results)) {
        const Measurement& largest = largestOf(group);
        auto& all = sizes[{largest.width, largest.height}];
        all.insert(all.end(), group.begin(), group.end());
    }
    std::vector<ParetoMean> means;
    for (const auto& [size, measurements] : sizes) {
        ParetoMean& mean = means.emplace_back();
        const auto settings = grouped(measurements, [](const Measurement& measurement) {
            return std::pair(measurement.technique, measurement.value);
        });
        for (const auto& setting : settings) {
            mean.push_back(average(setting));
        }
    }
    return means;
}

std::vector<const Measurement*> pointersTo(const ParetoMean& mean) {
    std::vector<const Measurement*> pointers;
    for (const Measurement& measurement : mean) {
        pointers.push_back(&measurement);
    }
    return pointers;
}

std::vector<const Measurement*> paretoFrontier(const std::vector<const Measurement*>& measurements) {
    std::vector<const Measurement*> byTime = measurements;
    std::sort(byTime.begin(), byTime.end(), [](const Measurement* a, const Measurement* b) {
        return std::pair(a->effect.median, -a->error->psnr) < std::pair(b->effect.median, -b->error->psnr);
    });
    std::vector<const Measurement*> frontier;
    double best = -std::numeric_limits<double>::infinity();
    for (const Measurement* measurement : byTime) {
        if (measurement->error->psnr > best) {
            best = measurement->error->psnr;
            frontier.push_back(measurement);
        }
    }
    return frontier;
}

} // namespace nacre::bench
