#include "app/bench/markdown.hpp"

#include "app/bench/charts.hpp"
#include "app/bench/conclusion.hpp"
#include "app/bench/fits.hpp"
#include "app/bench/text.hpp"

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

std::string slopes(const Results& results) {
    std::string rows;
    for (const Fit& fit : results.fits) {
        if (fit.quantity == "effect") {
            rows += row({fit.series, fit.technique, fit.width == 0 ? "all" : formatSize(fit.width, fit.height),
                         formatSlope(fit), formatNumber(fit.line.rSquared, 4), formatNumber(fit.growth) + "×",
                         formatShare(fit.noise), verdictOf(fit)});
        }
    }
    return table(
        {"series", "technique", "size", "slope of the effect's time (95 %)", "R²", "last / first", "noise", "verdict"},
        rows);
}

std::string errors(const Results& results) {
    std::string rows;
    for (const auto& group : paretoGroups(results)) {
        const std::vector<const Measurement*> frontier = paretoFrontier(group);
        for (const Measurement* m : group) {
            const bool onFrontier = std::find(frontier.begin(), frontier.end(), m) != frontier.end();
            rows +=
                row({m->view, formatSize(m->width, m->height), m->technique, m->value > 0 ? formatNumber(m->value) : "",
                     formatTime(m->effect.median), formatNumber(m->error->psnr) + " dB", formatNumber(m->error->relMse),
                     onFrontier ? "yes" : ""});
        }
    }
    return table({"view", "size", "technique", "quality", "time", "PSNR", "relMSE", "not beaten"}, rows);
}

} // namespace

std::string formatMarkdown(const Results& results) {
    const Machine& machine = results.machine;
    std::string text = "## Suite " + results.suite + " on " + machine.device + "\n\n";
    text += machine.device + " (" + machine.kind + "), " + machine.driver + ", Vulkan " + machine.apiVersion + "; " +
            machine.processor + ", " + std::to_string(machine.threads) + " threads; " + results.created + "; commit " +
            results.commit + (results.procedure.quick ? "; quick" : "") + "; " +
            formatNumber(results.procedure.seconds) + " s.\n\n";
    return text + conclude(results) + "\n\n" + slopes(results) + errors(results);
}

} // namespace nacre::bench
