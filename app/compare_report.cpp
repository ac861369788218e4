#include "app/compare_report.hpp"

#include "app/json_report.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nacre::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr int reportVersion = 1;

template <typename... Values> std::string format(const char* pattern, Values... values) {
    std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, pattern, values...)), '\0');
    std::snprintf(text.data(), text.size() + 1, pattern, values...);
    return text;
}

std::string row(const std::string& label, const std::string& text) {
    return format("  %-9s ", label.c_str()) + text + '\n';
}

double energyError(const Comparison& comparison) {
    double error = 0;
    for (const double ratio : comparison.energyRatio) {
        error = std::max(error, std::abs(ratio - 1));
    }
    return error;
}

bool isHdr(const CompareInputs& inputs) {
    return inputs.settings.flip == FlipKind::Hdr;
}

std::string describeFlip(const CompareInputs& inputs, const Comparison& comparison) {
    const FlipSummary& flip = comparison.flip;
    std::string text = format("mean %.4f, median %.4f, 95 %% of pixels below %.4f, largest %.4f", flip.mean,
                              flip.median, flip.percentile95, flip.largest);
    if (isHdr(inputs)) {
        text += format("\n            at %d exposures from %+.2f to %+.2f stops", comparison.exposures.count,
                       comparison.exposures.start, comparison.exposures.stop);
    }
    return text;
}

std::string describePsnr(const Comparison& comparison) {
    return std::isinf(comparison.psnr) ? "infinite: there is no difference"
                                       : format("%.2f dB, peak %.4g", comparison.psnr, comparison.peak);
}

std::string describeChance(const ChanceTest& chance) {
    if (chance.count == 0) {
        return "no value has a variance";
    }
    return format("%.2f %% of values beyond 3 standard errors (chance: %.2f %%)\n"
                  "            chi squared per degree of freedom %.3f (chance: 1)",
                  100 * chance.beyondShare, 100 * normalBeyondShare, chance.chiSquared);
}

std::string describePixels(const CompareOptions& options, const CompareInputs& inputs, const Comparison& comparison) {
    std::string text = format("%zu of %zu", comparison.pixels, comparison.reference.pixelCount());
    if (!options.mask.empty()) {
        text += ", mask " + options.mask;
    }
    for (std::size_t i = 0; i < inputs.materials.size(); ++i) {
        text += (i == 0 ? ", material " : ", ") + inputs.materials[i];
    }
    return text;
}

Json describeImage(const std::filesystem::path& file, const Image& image, std::size_t notFinite) {
    return {{"file", file.string()},
            {"width", image.width},
            {"height", image.height},
            {"encoding", image.encoding == Encoding::Srgb ? "sRGB" : "linear"},
            {"notFinite", notFinite}};
}

Json finiteOrNull(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json flipJson(const CompareInputs& inputs, const Comparison& comparison) {
    const FlipSummary& flip = comparison.flip;
    Json result{{"kind", isHdr(inputs) ? "hdr" : "ldr"},
                {"pixelsPerDegree", inputs.settings.pixelsPerDegree},
                {"mean", flip.mean},
                {"median", flip.median},
                {"percentile95", flip.percentile95},
                {"largest", flip.largest}};
    if (isHdr(inputs)) {
        result["exposures"] = {{"start", comparison.exposures.start},
                               {"stop", comparison.exposures.stop},
                               {"count", comparison.exposures.count}};
    }
    return result;
}

Json chanceJson(const ChanceTest& chance) {
    return {{"values", chance.count},
            {"beyond3StandardErrors", chance.beyondShare},
            {"expectedBeyond3StandardErrors", normalBeyondShare},
            {"chiSquaredPerDegreeOfFreedom", chance.chiSquared}};
}

} // namespace

std::vector<BoundCheck> checkBounds(const CompareOptions& options, const Comparison& comparison) {
    std::vector<BoundCheck> checks;
    const auto atMost = [&](const char* option, const std::optional<double>& bound, double value) {
        if (bound) {
            checks.push_back({option, *bound, value, value <= *bound});
        }
    };
    atMost("--max-flip", options.maxFlip, comparison.flip.mean);
    if (options.minPsnr) {
        checks.push_back({"--min-psnr", *options.minPsnr, comparison.psnr, comparison.psnr >= *options.minPsnr});
    }
    atMost("--max-relmse", options.maxRelMse, comparison.relMse);
    atMost("--max-energy-error", options.maxEnergyError, energyError(comparison));
    return checks;
}

std::string describeComparison(const CompareOptions& options, const CompareInputs& inputs,
                               const Comparison& comparison) {
    std::string text = options.test.string() + " against " + options.reference.string() + ", " +
                       format("%u x %u pixels, ", comparison.reference.width, comparison.reference.height) +
                       (comparison.reference.encoding == Encoding::Srgb ? "as shown" : "linear light") + '\n';
    text += row("pixels", describePixels(options, inputs, comparison));
    text += row(isHdr(inputs) ? "HDR-FLIP" : "FLIP", describeFlip(inputs, comparison));
    text += row("PSNR", describePsnr(comparison));
    text += row("relMSE", format("%.4g, epsilon %.2g", comparison.relMse, relMseEpsilon));
    text += row("SSIM", format("%.4f", comparison.ssim));
    text += row("energy", format("R %.4f, G %.4f, B %.4f of the reference's", comparison.energyRatio[0],
                                 comparison.energyRatio[1], comparison.energyRatio[2]));
    if (comparison.chance) {
        text += row("chance", describeChance(*comparison.chance));
    }
    for (const auto& [file, count] :
         {std::pair(options.test, comparison.notFinite), std::pair(options.reference, comparison.referenceNotFinite)}) {
        if (count > 0) {
            text += row("note", format("%zu values of %s are not finite and count as 0", count, file.c_str()));
        }
    }
    return text;
}

std::string makeComparisonReport(const CompareOptions& options, const CompareInputs& inputs,
                                 const Comparison& comparison, const std::vector<BoundCheck>& bounds,
                                 double differenceRange) {
    Json report{{"schemaVersion", reportVersion},
                {"nacreVersion", NACRE_VERSION},
                {"test", describeImage(options.test, comparison.test, comparison.notFinite)},
                {"reference", describeImage(options.reference, comparison.reference, comparison.referenceNotFinite)},
                {"pixels", comparison.pixels},
                {"mask", options.mask.empty() ? Json() : Json(options.mask)},
                {"materials", inputs.materials},
                {"flip", flipJson(inputs, comparison)},
                {"peak", comparison.peak},
                {"psnr", finiteOrNull(comparison.psnr)},
                {"relMse", comparison.relMse},
                {"relMseEpsilon", relMseEpsilon},
                {"ssim", comparison.ssim},
                {"energyRatio", Json::array()},
                {"chance", comparison.chance ? chanceJson(*comparison.chance) : Json()}};
    for (const double ratio : comparison.energyRatio) {
        report["energyRatio"].push_back(finiteOrNull(ratio)); // of a channel that the reference does not have
    }
    report["bounds"] = Json::array();
    for (const BoundCheck& check : bounds) {
        report["bounds"].push_back({{"option", check.option},
                                    {"bound", check.bound},
                                    {"value", finiteOrNull(check.value)},
                                    {"holds", check.holds}});
    }
    report["files"] = Json::array();
    if (!options.difference.empty()) {
        report["files"].push_back(
            {{"image", "difference"}, {"file", options.difference.string()}, {"range", differenceRange}});
    }
    if (!options.heat.empty()) {
        report["files"].push_back({{"image", "heat"}, {"file", options.heat.string()}, {"range", 1}});
    }
    return formatReport(report);
}

} // namespace nacre::app
