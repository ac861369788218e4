#include "bench/report/html_report.hpp"

#include "bench/report/charts.hpp"
#include "bench/report/conclusion.hpp"
#include "bench/report/report_tables.hpp"
#include "bench/report/report_text.hpp"
#include "bench/suites/thesis_constants.hpp"
#include "chart_min_js.h"
#include "nacre/files.hpp"
#include "report_css.h"
#include "report_js.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace nacre::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t maxPictureBytes = std::uint64_t{64} << 20;

struct SuiteText {
    const char* suite;
    const char* title;
    const char* text;
};

constexpr SuiteText suiteTexts[] = {
    {"thesis", "The thesis's three experiments",
     "The measurements of chapter 4.5, repeated with every technique, many frames and a stated confidence."},
    {"sweep", "What the time depends on",
     "One quantity varies, all others stay. A flat line means that the quantity costs nothing."},
    {"pareto", "Error against time", "Every technique at its quality settings: how wrong, and how fast."}};

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            word = word << 8 | (j < count ? bytes[i + j] : 0u);
        }
        for (std::size_t j = 0; j < 4; ++j) {
            text += j <= count ? digits[word >> (18 - 6 * j) & 63] : '=';
        }
    }
    return text;
}

std::string picture(const std::filesystem::path& folder, const std::string& fileName, const std::string& name,
                    const char* role) {
    const std::filesystem::path file = folder / fileName;
    if (std::filesystem::weakly_canonical(file).parent_path() != std::filesystem::weakly_canonical(folder)) {
        throw FileError(file.string() + ": is not beside results.json, as a report's pictures are");
    }
    const char* type = file.extension() == ".png" ? "image/png" : "image/jpeg";
    return "<img class=\"" + std::string(role) + "\" alt=\"" + escapeHtml(name) + "\" src=\"data:" + type + ";base64," +
           base64(readFile(file, maxPictureBytes)) + "\">";
}

std::string figure(const ImagePair& pair, const std::filesystem::path& folder) {
    return "<figure class=\"pair\"><h3>" + escapeHtml(pair.title) + "</h3><div class=\"stage\">" +
           picture(folder, pair.beforeFile, pair.before, "before") +
           picture(folder, pair.afterFile, pair.after, "after") +
           "</div><input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"" + escapeHtml(pair.title) +
           "\"><div class=\"names\"><span>" + escapeHtml(pair.before) + "</span><span>" + escapeHtml(pair.after) +
           "</span></div></figure>\n";
}

std::string pairs(const Results& results, const std::string& series, const std::filesystem::path& folder) {
    std::string figures;
    for (const ImagePair& pair : results.images) {
        if (pair.series == series) {
            figures += figure(pair, folder);
        }
    }
    return figures.empty() ? "" : "<div class=\"pairs\">\n" + figures + "</div>\n";
}

const char* nameOf(ChartSetKind kind) {
    switch (kind) {
    case ChartSetKind::Floor:
        return "floor";
    case ChartSetKind::Thesis:
        return "thesis";
    case ChartSetKind::Frontier:
        return "frontier";
    case ChartSetKind::Measured:
        break;
    }
    return "measured";
}

Json toJson(const Chart& chart) {
    Json sets = Json::array();
    for (const ChartSet& set : chart.sets) {
        Json points = Json::array();
        for (const ChartPoint& point : set.points) {
            points.push_back(
                {{"x", point.x}, {"y", point.y}, {"low", point.low}, {"high", point.high}, {"label", point.label}});
        }
        sets.push_back({{"name", set.name},
                        {"kind", nameOf(set.kind)},
                        {"color", set.color},
                        {"joined", set.joined},
                        {"points", std::move(points)}});
    }
    return {{"xLabel", chart.xLabel},
            {"yLabel", chart.yLabel},
            {"logX", chart.logX},
            {"logY", chart.logY},
            {"sets", std::move(sets)}};
}

// The document's body, and the plots' data collected on the way.
class Report {
public:
    Report(const Results& results, const std::filesystem::path& folder) : results_(results), folder_(folder) {}

    std::string html() {
        std::string body = header();
        const auto groups = paretoGroups(results_);
        for (const std::string& series : seriesOf(results_)) {
            body += isIn(groups, series) ? "" : seriesSection(series);
        }
        body += (groups.empty() ? "" : paretoSection(groups)) + appendix();
        return document(body);
    }

private:
    SuiteText suite() const {
        for (const SuiteText& text : suiteTexts) {
            if (results_.suite == text.suite) {
                return text;
            }
        }
        return {"", "Benchmark", ""};
    }

    std::string header() const {
        const SuiteText text = suite();
        return "<h1>" + std::string(text.title) + "</h1>\n<p class=\"facts\">" +
               escapeHtml(results_.machine.device + " · " + results_.created + " · Nacre " + results_.nacreVersion +
                          ", commit " + results_.commit + " · " + std::to_string(results_.measurements.size()) +
                          " configurations") +
               "</p>\n<p>" + text.text + "</p>\n<p class=\"conclusion\">" + escapeHtml(conclude(results_)) + "</p>\n";
    }

    // `heading` is what they show, where one of them stands alone.
    std::string plots(const std::vector<Chart>& charts, const std::string& heading) {
        std::string figures;
        for (const Chart& chart : charts) {
            figures += "<figure class=\"chart\"><h3>" + escapeHtml(chart.title) +
                       "</h3><div class=\"canvas\"><canvas role=\"img\" aria-label=\"" +
                       escapeHtml(heading + ": " + chart.title) + "\" data-chart=\"" + std::to_string(charts_.size()) +
                       "\"></canvas></div></figure>\n";
            charts_.push_back(toJson(chart));
        }
        return "<div class=\"charts\">\n" + figures + "</div>\n";
    }

    std::string details(const std::string& summary, const std::string& content) const {
        return content.empty() ? "" : "<details><summary>" + summary + "</summary>\n" + content + "</details>\n";
    }

    std::string seriesSection(const std::string& series) {
        const SeriesText text = describeSeries(series);
        std::string html = "<h2>" + escapeHtml(text.series[0] != '\0' ? text.title : series) + "</h2>\n<p>" +
                           escapeHtml(text.text) + "</p>\n";
        if (series == "experiment 2") {
            html += "<p class=\"note\">" +
                    escapeHtml("The thesis states " + formatTime(thesis::radiusSlope720) + " per texel at 1280x720, " +
                               formatTime(thesis::radiusSlope1080) + " at 1920x1080, and close to " +
                               formatTime(thesis::largestRadiusTime1080) + " for radius " +
                               std::to_string(thesis::largestRadius) + " there, each measured once, on " +
                               thesis::machine + ".") +
                    "</p>\n";
        }
        html += plots(chartsOfSeries(results_, series), series);
        html += "<p class=\"note\">Points are medians, whiskers their 95 % confidence; the copy pass reads and writes "
                "the same pictures and does nothing else.</p>\n";
        html += slopeTable(results_, series) + pairs(results_, series, folder_);
        html += details("Slope of every pass", passSlopeTable(results_, series));
        html += details("Every pass at the end of the series", passTable(results_, series));
        return html + details("Every configuration", measurementTable(results_, series));
    }

    using Groups = std::vector<std::vector<const Measurement*>>;

    static bool isIn(const Groups& groups, const std::string& series) {
        return std::any_of(groups.begin(), groups.end(),
                           [&](const auto& group) { return group.front()->series == series; });
    }

    std::string paretoSection(const Groups& groups) {
        const SeriesText text = describeSeries(groups.front().front()->series);
        std::vector<Chart> charts;
        std::string tables;
        for (const ParetoMean& mean : paretoMeans(results_)) {
            const std::vector<const Measurement*> group = pointersTo(mean);
            charts.push_back(paretoChart(results_, group));
            tables += "<h3>" + escapeHtml(describeParetoGroup(group)) + "</h3>\n" + paretoTable(group);
        }
        std::string html = "<h2>" + std::string(text.title) + "</h2>\n<p>" + escapeHtml(text.text) + "</p>\n" +
                           plots(charts, text.title) + tables + pairs(results_, "pareto", folder_) +
                           "<h2>Each view and footprint</h2>\n";
        charts.clear();
        for (const auto& group : groups) {
            charts.push_back(paretoChart(results_, group));
        }
        html += plots(charts, text.title);
        for (const auto& group : groups) {
            html += details(escapeHtml(describeParetoGroup(group)),
                            paretoTable(group) + measurementTable(results_, group.front()->series));
        }
        return html;
    }

    std::string appendix() const {
        return "<h2>Noise floor</h2>\n<p>One configuration of each series, measured twice as if it were two. Smaller "
               "differences than this mean nothing.</p>\n" +
               noiseTable(results_) + "<h2>Memory</h2>\n" + memoryTable(results_) + "<h2>Machine and procedure</h2>\n" +
               machineTable(results_);
    }

    std::string document(const std::string& body) const {
        std::string data = charts_.dump();
        for (std::size_t at = 0; (at = data.find('<', at)) != std::string::npos;) {
            data.replace(at, 1, "\\u003c");
        }
        std::string html =
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
            "name=\"viewport\" content=\"width=device-width\">\n<link rel=\"icon\" href=\"data:,\">\n<title>"
            "Nacre: " +
            std::string(suite().title) + "</title>\n<style>\n";
        html += report_css;
        html += "</style>\n</head>\n<body>\n" + body + "<script type=\"application/json\" id=\"charts\">" + data +
                "</script>\n<script>\n";
        html += chart_min_js;
        html += "</script>\n<script>\n";
        html += report_js;
        return html + "</script>\n</body>\n</html>\n";
    }

    const Results& results_;
    const std::filesystem::path& folder_;
    Json charts_ = Json::array();
};

} // namespace

std::string formatReport(const Results& results, const std::filesystem::path& folder) {
    return Report(results, folder).html();
}

} // namespace nacre::bench
