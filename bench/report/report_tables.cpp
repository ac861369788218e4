#include "bench/report/report_tables.hpp"

#include "bench/report/charts.hpp"
#include "bench/report/report_text.hpp"
#include "bench/results/series_fits.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace nacre::bench {
namespace {

// Rows of cells; the first `textColumns` are text, the others numbers.
class Table {
public:
    Table(const std::vector<std::string>& header, std::size_t textColumns) : textColumns_(textColumns) {
        html_ = row(header, "th");
    }

    void add(const std::vector<std::string>& cells) {
        html_ += row(cells, "td");
        ++rows_;
    }

    std::string html() const {
        return rows_ == 0 ? "" : "<div class=\"scroll\"><table>\n" + html_ + "</table></div>\n";
    }

private:
    std::string row(const std::vector<std::string>& cells, const std::string& tag) const {
        std::string text = "<tr>";
        for (std::size_t i = 0; i < cells.size(); ++i) {
            text += "<" + tag + (i < textColumns_ ? " class=\"text\">" : ">") + escapeHtml(cells[i]) + "</" + tag + ">";
        }
        return text + "</tr>\n";
    }

    std::size_t textColumns_;
    std::size_t rows_ = 0;
    std::string html_;
};

std::string formatInterval(double low, double high) {
    return formatNumber(low) + " … " + formatNumber(high);
}

void addSlope(Table& table, const Fit& fit) {
    table.add({fit.technique, fit.width == 0 ? "all" : formatSize(fit.width, fit.height), fit.quantity,
               formatSlope(fit), formatInterval(fit.line.slopeLow, fit.line.slopeHigh),
               formatNumber(fit.line.robustSlope), formatNumber(fit.line.rSquared, 4), formatTime(fit.line.intercept),
               formatNumber(fit.spread) + "×", formatShare(fit.noise), verdictOf(fit)});
}

std::vector<std::string> slopeHeader() {
    return {"technique",          "size",  "time of", "slope", "95 % interval (µs)", "Theil–Sen (µs)", "R²", "at 0",
            "largest / smallest", "noise", "verdict"};
}

// Those of more than one pass.
constexpr std::string_view wholes[] = {"effect", scatterQuantity, "frame"};

bool isWhole(std::string_view quantity) {
    return std::find(std::begin(wholes), std::end(wholes), quantity) != std::end(wholes);
}

} // namespace

std::string slopeTable(const Results& results, const std::string& series) {
    Table table(slopeHeader(), 3);
    for (const std::string_view quantity : wholes) {
        for (const Fit* fit : fitsOf(results, series, quantity)) {
            addSlope(table, *fit);
        }
    }
    return table.html();
}

std::string passSlopeTable(const Results& results, const std::string& series) {
    Table table(slopeHeader(), 3);
    for (const Fit& fit : results.fits) {
        if (fit.series == series && !isWhole(fit.quantity)) {
            addSlope(table, fit);
        }
    }
    return table.html();
}

std::string measurementTable(const Results& results, const std::string& series) {
    std::string variable = "value";
    for (const Measurement& measurement : results.measurements) {
        if (measurement.series == series) {
            variable =
                measurement.unit.empty() ? measurement.variable : measurement.variable + " (" + measurement.unit + ")";
        }
    }
    Table table({"technique",      "size",           variable,        "effect (µs)", "95 % of the median", "p5 … p95",
                 "frames",         "copy (µs)",      "copy / effect", "copy (MB)",   "copy (GB/s)",        "frame (µs)",
                 "passes / frame", "recording (µs)", "noise",         "coverage",    "footprint (px)",     "lights",
                 "materials",      "layers",         "triangles",     "dispatches"},
                2);
    for (const Measurement& m : results.measurements) {
        if (m.series != series) {
            continue;
        }
        const double floorShare = m.effect.median > 0 ? m.copy.median / m.effect.median : 0;
        const double bandwidth = m.copy.median > 0 ? static_cast<double>(m.copyBytes) / m.copy.median * 1e-3 : 0;
        table.add({m.technique,
                   formatSize(m.width, m.height),
                   formatNumber(m.value, 5),
                   formatNumber(m.effect.median, 4),
                   formatInterval(m.effect.low, m.effect.high),
                   formatInterval(m.effect.p5, m.effect.p95),
                   std::to_string(m.effect.count),
                   formatNumber(m.copy.median),
                   formatShare(floorShare),
                   formatNumber(1e-6 * static_cast<double>(m.copyBytes)),
                   formatNumber(bandwidth),
                   formatNumber(m.frame.median, 4),
                   formatShare(m.passShare),
                   formatNumber(m.recording.median),
                   formatShare(m.noise),
                   formatShare(m.coverage),
                   formatNumber(m.footprint),
                   std::to_string(m.lights),
                   std::to_string(m.materials),
                   std::to_string(m.layers),
                   formatCount(m.triangles),
                   std::to_string(m.dispatches)});
    }
    return table.html();
}

std::string passTable(const Results& results, const std::string& series) {
    // The last measurement of each technique with the most pixels.
    std::map<std::string, const Measurement*> largest;
    for (const Measurement& measurement : results.measurements) {
        if (measurement.series == series) {
            const Measurement*& held = largest[measurement.technique];
            if (held == nullptr || measurement.width * measurement.height >= held->width * held->height) {
                held = &measurement;
            }
        }
    }
    Table table({"technique", "size", "pass", "median (µs)", "p5 … p95", "share of the frame"}, 3);
    for (const std::string& technique : techniquesOf(results)) {
        const Measurement* measurement = largest[technique];
        if (measurement == nullptr) {
            continue;
        }
        for (const PassResult& pass : measurement->passes) {
            table.add({technique, formatSize(measurement->width, measurement->height), pass.name,
                       formatNumber(pass.value.median), formatInterval(pass.value.p5, pass.value.p95),
                       formatShare(ratioOf(pass.value.median, measurement->frame.median))});
        }
    }
    return table.html();
}

std::string paretoTable(const std::vector<const Measurement*>& group) {
    const std::vector<const Measurement*> frontier = paretoFrontier(group);
    Table table({"technique", "setting", "effect (µs)", "95 % of the median", "noise", "PSNR (dB)", "relMSE",
                 "energy ratio", "not beaten"},
                2);
    for (const Measurement* m : group) {
        const bool onFrontier = std::find(frontier.begin(), frontier.end(), m) != frontier.end();
        table.add({m->technique, formatSetting(*m), formatNumber(m->effect.median, 4),
                   formatInterval(m->effect.low, m->effect.high), formatShare(m->noise),
                   formatNumber(m->error->psnr, 4), formatNumber(m->error->relMse),
                   formatNumber(m->error->energyRatio, 4), onFrontier ? "yes" : ""});
    }
    return table.html();
}

std::string noiseTable(const Results& results) {
    Table table({"series", "configuration", "first (µs)", "95 %", "second (µs)", "95 %", "noise floor"}, 2);
    for (const NoiseFloor& floor : results.noiseFloors) {
        table.add({floor.series, floor.id, formatNumber(floor.first.median, 4),
                   formatInterval(floor.first.low, floor.first.high), formatNumber(floor.second.median, 4),
                   formatInterval(floor.second.low, floor.second.high), formatShare(floor.share)});
    }
    return table.html();
}

std::string memoryTable(const Results& results) {
    Table table({"technique", "size", "what", "MiB"}, 3);
    std::set<std::pair<std::string, std::string>> told;
    for (const Measurement& measurement : results.measurements) {
        const std::string size = formatSize(measurement.width, measurement.height);
        if (!told.insert({measurement.technique, size}).second) {
            continue;
        }
        for (const MemoryUse& use : measurement.memory) {
            table.add(
                {measurement.technique, size, use.name, formatNumber(static_cast<double>(use.value) / 1048576.0)});
        }
    }
    return table.html();
}

std::string machineTable(const Results& results) {
    const Machine& machine = results.machine;
    Table table({"what", ""}, 2);
    table.add({"device", machine.device + " (" + machine.kind + ")"});
    table.add({"driver", machine.driver + ", Vulkan " + machine.apiVersion});
    table.add({"processor", machine.processor + ", " + std::to_string(machine.threads) + " threads"});
    for (const Clock& clock : machine.clocks) {
        table.add({"clock: " + clock.name, formatNumber(clock.before, 4) + " MHz at the start, " +
                                               formatNumber(clock.after, 4) + " MHz at the end"});
    }
    if (machine.clocks.empty()) {
        table.add({"clocks", "could not be read"});
    }
    if (!results.measurements.empty()) {
        table.add({"sum of the passes / frame", formatPassShares(results)});
    }
    table.add({"scene", results.scene});
    table.add({"sources", "Nacre " + results.nacreVersion + ", commit " + results.commit});
    table.add({"procedure",
               std::string(results.procedure.quick ? "quick; " : "") + std::to_string(results.procedure.warmUpFrames) +
                   " warm-up frames a configuration; then rounds in which every configuration of a series takes its "
                   "turn: of frames, and of up to " +
                   std::to_string(results.procedure.repetitions) + " repetitions of the effect; " +
                   formatNumber(results.procedure.seconds) + " s in all"});
    return table.html();
}

} // namespace nacre::bench
