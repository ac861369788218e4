#include "app/bake_report.hpp"

#include "app/json_report.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>

namespace nacre::app {

namespace {

constexpr int bakeReportVersion = 1;
constexpr double millimetresPerMetre = 1000;

std::string thicknessText(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

} // namespace

ThicknessRange rangeOf(std::span<const float> millimetres) {
    if (millimetres.empty()) {
        return {};
    }
    const auto [least, most] = std::ranges::minmax(millimetres);
    const double sum = std::accumulate(millimetres.begin(), millimetres.end(), 0.0);
    return {least, sum / static_cast<double>(millimetres.size()), most};
}

std::string makeReport(const BakeOptions& options, const BakeResult& result) {
    using Json = nlohmann::ordered_json;
    const ThicknessRange range = rangeOf(result.state.millimetres);
    Json report{{"schemaVersion", bakeReportVersion},
                {"nacreVersion", NACRE_VERSION},
                {"scene", describeScene(result.scene, result.notes)},
                {"surface", result.surface.empty() ? Json(nullptr) : Json(result.surface)},
                {"law", result.law},
                {"rays", options.settings.samples},
                {"places", result.state.millimetres.size()},
                {"millimetres", {{"least", range.least}, {"mean", range.mean}, {"most", range.most}}},
                {"seconds", result.secondsOfRun},
                {"totalSeconds", result.state.seconds},
                {"warnings", result.warnings},
                {"file", options.output.string()}};
    if (result.white > 0) {
        report["white"] = result.white;
        report["thicknessFactor"] = result.white / millimetresPerMetre;
    }
    return formatReport(report);
}

std::string describeBake(const BakeOptions& options, const BakeResult& result) {
    const ThicknessRange range = rangeOf(result.state.millimetres);
    std::string text = options.output.string() + ": " + result.scene;
    text += result.surface.empty() ? "" : ", surface '" + result.surface + "'";
    text += ", " + std::to_string(result.state.millimetres.size()) + (result.texels > 0 ? " of " : " vertices");
    text += result.texels > 0 ? std::to_string(result.texels) + " texels" : "";
    text += ", " + std::to_string(options.settings.samples) + " rays each, " + result.law + ": " +
            thicknessText(range.least) + " to " + thicknessText(range.most) + " mm, mean " + thicknessText(range.mean) +
            " mm\n";
    if (result.white > 0) {
        text += "white is " + thicknessText(result.white) +
                " mm: \"thicknessFactor\": " + thicknessText(result.white / millimetresPerMetre) + '\n';
    }
    return text;
}

} // namespace nacre::app
