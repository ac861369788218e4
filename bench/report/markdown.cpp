#include "bench/report/markdown.hpp"

#include "bench/report/charts.hpp"
#include "bench/report/conclusion.hpp"
#include "bench/report/report_text.hpp"
#include "bench/results/series_fits.hpp"

#include <algorithm>

namespace nacre::bench {
namespace {

std::string row(const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) {
        text += " " + cell + " |";
    }
    return text + "\n";
}

std::string table(const std::vector<std::string>& header, const std::string& rows) {
    return rows.empty() ? "" : row(header) + row(std::vector<std::string>(header.size(), "---")) + rows + "\n";
}

std::string slopes(const Results& results, const std::string& quantity, const std::string& title) {
    std::string rows;
    for (const Fit& fit : results.fits) {
        if (fit.quantity == quantity) {
            rows += row({fit.series, fit.technique, fit.width == 0 ? "all" : formatSize(fit.width, fit.height),
                         formatSlope(fit), formatNumber(fit.line.rSquared, 4), formatNumber(fit.spread) + "×",
                         formatShare(fit.noise), verdictOf(fit)});
        }
    }
    return table({"series", "technique", "size", "slope of " + title + " (95 %)", "R²", "largest / smallest", "noise",
                  "verdict"},
                 rows);
}

// How far a setting of the mean is from the reference at worst, dB.
double worstPsnr(const Results& results, const Measurement& mean) {
    double worst = maxPsnr;
    for (const Measurement& measurement : results.measurements) {
        const bool same = measurement.technique == mean.technique && measurement.value == mean.value &&
                          measurement.width == mean.width && measurement.height == mean.height;
        worst = same && measurement.error ? std::min(worst, measurement.error->psnr) : worst;
    }
    return worst;
}

std::string errors(const Results& results) {
    std::string text;
    for (const ParetoMean& mean : paretoMeans(results)) {
        const std::vector<const Measurement*> group = pointersTo(mean);
        const std::vector<const Measurement*> frontier = paretoFrontier(group);
        std::string rows;
        for (const Measurement* m : group) {
            const bool onFrontier = std::find(frontier.begin(), frontier.end(), m) != frontier.end();
            rows += row({m->technique, formatSetting(*m), formatTime(m->effect.median),
                         formatNumber(m->error->psnr) + " dB", formatNumber(worstPsnr(results, *m)) + " dB",
                         formatNumber(m->error->relMse), onFrontier ? "yes" : ""});
        }
        text += "Error against time, " + describeParetoGroup(group) + ":\n\n" +
                table({"technique", "setting", "time", "PSNR", "worst PSNR", "relMSE", "not beaten"}, rows);
    }
    return text;
}

} // namespace

std::string formatMarkdown(const Results& results) {
    const Machine& machine = results.machine;
    std::string text = "## Suite " + results.suite + " on " + machine.device + "\n\n";
    text += machine.device + " (" + machine.kind + "), " + machine.driver + ", Vulkan " + machine.apiVersion + "; " +
            machine.processor + ", " + std::to_string(machine.threads) + " threads; " + results.created + "; commit " +
            results.commit + (results.procedure.quick ? "; quick" : "") + "; " +
            formatNumber(results.procedure.seconds) + " s.\n\n";
    if (!results.measurements.empty()) {
        text += "The passes of a frame, timed one by one, add up to " + formatPassShares(results) +
                " of the frame timed as a whole.\n\n";
    }
    return text + conclude(results) + "\n\n" + slopes(results, "effect", "the effect's time") +
           slopes(results, scatterQuantity, "scatter's own time") + errors(results);
}

} // namespace nacre::bench
