#include "bench/report/conclusion.hpp"

#include "bench/report/charts.hpp"
#include "bench/report/report_text.hpp"
#include "bench/results/series_fits.hpp"
#include "bench/suites/thesis_constants.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace nacre::bench {
namespace {

// From this R² on a series is called a line.
constexpr double linearFrom = 0.95;

std::string at(const Fit& fit) {
    return fit.width == 0 ? "" : " at " + formatSize(fit.width, fit.height);
}

std::string formatR2(const Line& line) {
    return "R² " + formatNumber(line.rSquared, 4);
}

// What it was measured on and what counts as a difference.
std::string opening(const Results& results) {
    double noise = 0;
    std::size_t fewest = results.measurements.front().effect.count;
    for (const Measurement& measurement : results.measurements) {
        noise = std::max(noise, measurement.noise);
        fewest = std::min(fewest, measurement.effect.count);
    }
    return "On " + results.machine.device + ", with at least " + std::to_string(fewest) + " measurements of each of " +
           std::to_string(results.measurements.size()) + " configurations and a noise floor of up to " +
           formatShare(noise) + ": ";
}

// Only the largest picture of the series is told in words; the tables have all.
std::vector<const Fit*> largestOf(std::vector<const Fit*> fits) {
    std::uint32_t height = 0;
    for (const Fit* fit : fits) {
        height = std::max(height, fit->height);
    }
    std::erase_if(fits, [height](const Fit* fit) { return fit->height != height; });
    return fits;
}

// Of the experiments, which the thesis made, and of the sweep, which it did not.
std::string thesisSentence(const Fit& fit) {
    const std::string slope = formatSlope(fit) + at(fit) + " (" + formatR2(fit.line) + ")";
    const bool compares = fit.series.starts_with("experiment");
    if (verdictOf(fit) != "grows") {
        return std::string("the thesis's technique ") + (verdictOf(fit) == noLine ? "follows " : "is ") +
               verdictOf(fit) + ": " + slope + (compares ? ", where the thesis has a straight line" : "");
    }
    const bool isLine = fit.line.rSquared >= linearFrom;
    std::string text = "the thesis's technique grows by " + slope;
    if (compares) {
        text += isLine ? ", its straight line" : ", which is not the thesis's straight line";
    }
    if (fit.series == "experiment 2" && isLine) {
        text += "; the hardware of 2011 needed " + formatTime(thesis::radiusSlope1080) + " at 1920x1080";
    }
    return text;
}

// Of one that is not flat.
std::string changeOf(const Fit& fit) {
    const std::string spread = formatNumber(fit.spread) + "-fold in all";
    return verdictOf(fit) == noLine ? "follows no line (" + spread + ")"
                                    : verdictOf(fit) + " by " + formatSlope(fit) + " (" + spread + ")";
}

std::string othersSentence(const std::vector<const Fit*>& fits) {
    std::vector<std::string> flat;
    std::vector<std::string> unclear;
    std::vector<std::string> parts;
    for (const Fit* fit : fits) {
        const std::string verdict = verdictOf(*fit);
        if (verdict == "flat") {
            flat.push_back(fit->technique);
        } else if (verdict == tooNoisyToTell) {
            unclear.push_back(fit->technique);
        } else {
            parts.push_back(fit->technique + " " + changeOf(*fit));
        }
    }
    if (!flat.empty()) {
        parts.insert(parts.begin(),
                     join(flat) + (flat.size() == 1 ? " is" : " are") + " flat within its confidence or the noise");
    }
    if (!unclear.empty()) {
        parts.push_back("of " + join(unclear) + " the noise hides whether it changes");
    }
    std::string text;
    for (const std::string& part : parts) {
        text += (text.empty() ? "" : "; ") + part;
    }
    return text;
}

std::string seriesSentence(const Results& results, const std::string& series) {
    std::vector<const Fit*> fits = largestOf(fitsOf(results, series, "effect"));
    if (fits.empty()) {
        return {};
    }
    const std::string variable = fits.front()->variable;
    std::string text = "In " + series + " (against " + variable + at(*fits.front()) + "), ";
    const auto thesisFit =
        std::find_if(fits.begin(), fits.end(), [](const Fit* fit) { return fit->technique == "thesis"; });
    if (thesisFit != fits.end()) {
        text += thesisSentence(**thesisFit) + ". ";
        fits.erase(thesisFit);
        text += fits.empty() ? "" : "There, ";
    }
    return text + (fits.empty() ? "" : othersSentence(fits) + ". ");
}

// RQ2: what a kernel baked into the shader saves, over all configurations that were measured both ways.
std::string bakedSentence(const Results& results) {
    std::map<std::tuple<std::string, std::uint32_t, double>, const Measurement*> buffered;
    for (const Measurement& measurement : results.measurements) {
        if (measurement.technique == "thesis") {
            buffered[{measurement.series, measurement.height, measurement.value}] = &measurement;
        }
    }
    std::vector<double> ratios;
    std::size_t faster = 0;
    for (const Measurement& measurement : results.measurements) {
        const auto found = buffered.find({measurement.series, measurement.height, measurement.value});
        if (measurement.technique != "thesis-baked" || found == buffered.end()) {
            continue;
        }
        const Measurement& other = *found->second;
        const double noise = std::max(measurement.noise, other.noise);
        faster += compareTimes(other.effect, measurement.effect, noise) == Verdict::Better ? 1 : 0;
        ratios.push_back(ratioOf(measurement.effect.median, other.effect.median));
    }
    if (ratios.empty()) {
        return {};
    }
    std::sort(ratios.begin(), ratios.end());
    return "A kernel baked into the shader takes " + formatNumber(percentile(ratios, 0.5)) +
           " times the time of one in a storage buffer (median of " + std::to_string(ratios.size()) +
           " configurations; beyond noise it is faster in " + std::to_string(faster) + "). ";
}

std::string paretoSentence(const std::vector<const Measurement*>& group) {
    std::vector<std::string> points;
    for (const Measurement* measurement : paretoFrontier(group)) {
        points.push_back(measurement->technique + " at " + formatSetting(*measurement) + " (" +
                         formatTime(measurement->effect.median) + ", " + formatNumber(measurement->error->psnr) +
                         " dB)");
    }
    return "Over the " + describeParetoGroup(group) + ", of " + std::to_string(group.size()) +
           " settings nothing beats " + join(points) + ". ";
}

} // namespace

std::string conclude(const Results& results) {
    if (results.measurements.empty()) {
        return "Nothing was measured.";
    }
    std::string text = opening(results);
    for (const std::string& series : seriesOf(results)) {
        text += seriesSentence(results, series);
    }
    text += bakedSentence(results);
    for (const ParetoMean& mean : paretoMeans(results)) {
        text += paretoSentence(pointersTo(mean));
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

} // namespace nacre::bench
