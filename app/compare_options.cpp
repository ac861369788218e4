#include "app/compare_options.hpp"

#include "app/command.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <limits>

namespace nacre::app {

namespace {

constexpr double largest = std::numeric_limits<float>::max();

CompareMetric parseMetric(const std::string& name) {
    if (name == "auto") {
        return CompareMetric::Auto;
    }
    if (name == "ldr") {
        return CompareMetric::Ldr;
    }
    if (name == "hdr") {
        return CompareMetric::Hdr;
    }
    throw UsageError("there is no metric '" + name + "'; there are auto, ldr, hdr");
}

void requirePng(const std::filesystem::path& file, const std::string& option) {
    if (!file.empty() && file.extension() != ".png") {
        throw UsageError(option + " '" + file.string() + "' does not end in .png");
    }
}

void requireBound(const std::optional<double>& bound, double low, double high, const std::string& option) {
    if (bound) {
        requireRange(*bound, low, high, option);
    }
}

/// No output may replace another one or an input.
void requireDistinctPictures(const CompareOptions& options) {
    const std::filesystem::path inputs[] = {options.test,   options.reference, options.materialImage,
                                            options.report, options.variance,  options.mask};
    std::vector<std::filesystem::path> outputs{options.difference, options.heat, options.json};
    std::erase(outputs, std::filesystem::path());
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        const auto isSame = [&](const std::filesystem::path& other) {
            return output->lexically_normal() == other.lexically_normal();
        };
        if (std::any_of(outputs.begin(), output, isSame) || std::ranges::any_of(inputs, isSame)) {
            throw UsageError("the same file is given twice: '" + output->string() + "'");
        }
    }
}

constexpr const char* footer = R"(
PNG and JPEG files are compared as a display shows them, OpenEXR and HDR files as linear light; --metric makes them alike.
PSNR and SSIM are of the values as they are encoded; relMSE (epsilon 0.01) and energy are of linear light. FLIP is what an
observer sees who flips between the pictures: 0 nothing, below 0.01 practically the same, above 0.1 clearly different.

A variance image says how sure the reference is: R, G and B of --variance, or the channels variance.R, variance.G and
variance.B of REFERENCE and TEST, which `nacre reference` writes. The table then says whether the pictures differ by more
than chance.

Exit status: 0; 1 where a bound is exceeded or a file cannot be compared; 2 for a wrong command line.

Examples:
  nacre compare now.png before.png --max-flip 0.01        the same picture, for all that anybody sees
  nacre compare bank.exr brute.exr --mask id.exr:ID       only where the material id is not 0
  nacre compare bank.exr walk.exr --material 2 --heat where.png --difference signed.png
  nacre compare a.exr b.exr --material skin --report render.json --material-image id.exr
  nacre compare a.exr b.exr --json result.json --min-psnr 40 --max-energy-error 0.005

--suite renders a fixed set of views with every technique, computes the surface integral and the random walk of each, and
writes OUTPUT/accuracy.html, .json, .txt, .md, pictures and the references. References that are there and have samples
enough are taken as they are, so that a run after a change of the real-time code renders alone.

  nacre compare --suite --list
  nacre compare --suite --view 'wedge-*' --view fin --technique bank --technique off --reference surface
  nacre compare --suite --size 160x90 --time 5 --cache ~/references -o accuracy)";

} // namespace

CompareOptionParser::CompareOptionParser(CLI::App& command) : suite_(command) {
    CLI::Option* suite = command.get_option("--suite");
    const auto add = [&](const char* group, const char* name, auto& value, const char* description, const char* type) {
        command.add_option(name, value, description)
            ->type_name(type)
            ->group(group)
            ->allow_extra_args(false)
            ->excludes(suite);
    };
    command.add_option("TEST", options_.test, "The picture that is judged: PNG, JPEG, EXR or HDR")
        ->type_name("")
        ->excludes(suite);
    command.add_option("REFERENCE", options_.reference, "What it should be")->type_name("")->excludes(suite);

    add("Metric", "--metric", metric_, "FLIP of ldr (as shown) or hdr (linear light, all exposures); default auto",
        "NAME");
    add("Metric", "--ppd", options_.pixelsPerDegree,
        "Pixels per degree of the observer of FLIP; default 67.02: 0.7 m from 3840 pixels on 0.7 m", "N");
    add("Metric", "--peak", peak_,
        "What counts as full for PSNR and SSIM; default 1 for PNG, the reference's 99.9th percentile for EXR", "VALUE");

    add("Pixels that count", "--mask", options_.mask, "Those that are not 0 in this image; default its first channel",
        "FILE[:CHANNEL]");
    add("Pixels that count", "--material", options_.materials, "Those of this material; may be repeated", "ID|NAME");
    add("Pixels that count", "--material-image", options_.materialImage,
        "Where the ids are, as `nacre render --aov material=FILE.exr` writes them; default REFERENCE and TEST", "FILE");
    add("Pixels that count", "--report", options_.report, "Where the names are, as `nacre render --json` writes them",
        "FILE");

    add("Chance", "--variance", options_.variance, "The variance of every pixel's mean, channels R, G, B", "FILE");

    add("Results", "--difference", options_.difference, "TEST - REFERENCE: brighter than grey is more, darker is less",
        "FILE.png");
    add("Results", "--difference-range", differenceRange_, "The difference that is white; default the largest",
        "VALUE");
    add("Results", "--heat", options_.heat, "FLIP as colours: black 0, violet, red, orange, white 1", "FILE.png");
    addJsonOption(command, options_.json)->group("Results")->excludes(suite);

    add("Bounds", "--max-flip", options_.maxFlip, "Largest mean of FLIP", "[0..1]");
    add("Bounds", "--min-psnr", options_.minPsnr, "Smallest PSNR", "DB");
    add("Bounds", "--max-relmse", options_.maxRelMse, "Largest relMSE", "VALUE");
    add("Bounds", "--max-energy-error", options_.maxEnergyError, "Largest |energy - 1| of any channel", "VALUE");
    command.footer(footer);
}

CompareOptions CompareOptionParser::finish() const {
    CompareOptions options = options_;
    if (options.test.empty() || options.reference.empty()) {
        throw UsageError("TEST and REFERENCE are required, or --suite");
    }
    options.metric = parseMetric(metric_);
    requireRange(options.pixelsPerDegree, 1, 1000, "--ppd");
    requireBound(peak_, 1e-30, largest, "--peak");
    requireBound(differenceRange_, 1e-30, largest, "--difference-range");
    options.peak = peak_.value_or(0);
    options.differenceRange = differenceRange_.value_or(0);
    requireBound(options.maxFlip, 0, 1, "--max-flip");
    requireBound(options.minPsnr, 0, 1000, "--min-psnr");
    requireBound(options.maxRelMse, 0, largest, "--max-relmse");
    requireBound(options.maxEnergyError, 0, largest, "--max-energy-error");
    requirePng(options.difference, "--difference");
    requirePng(options.heat, "--heat");
    if (options.materials.empty() && (!options.materialImage.empty() || !options.report.empty())) {
        throw UsageError("--material-image and --report need --material");
    }
    requireDistinctPictures(options);
    return options;
}

} // namespace nacre::app
