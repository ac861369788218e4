// What `nacre compare` was asked for, parsed and checked; nothing here opens a file.
#pragma once

#include "app/suite_options.hpp"
#include "image/flip.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nacre::app {

/// How FLIP and the encoding of the images are chosen.
enum class CompareMetric {
    Auto, ///< by the files: Hdr of linear light, Ldr of what is made to be shown
    Ldr,
    Hdr,
};

struct CompareOptions {
    std::filesystem::path test;
    std::filesystem::path reference;
    CompareMetric metric = CompareMetric::Auto;
    double pixelsPerDegree = defaultPixelsPerDegree;
    double peak = 0;                    ///< 0 = chosen by the reference
    std::string mask;                   ///< FILE or FILE:CHANNEL; empty = none
    std::vector<std::string> materials; ///< ids or names, of which one must be a pixel's; empty = all pixels
    std::filesystem::path materialImage;
    std::filesystem::path report; ///< of `nacre render --json`, for the materials' names
    std::filesystem::path variance;
    std::filesystem::path difference;
    double differenceRange = 0; ///< 0 = the largest difference
    std::filesystem::path heat;
    std::filesystem::path json;
    std::optional<double> maxFlip;
    std::optional<double> minPsnr;
    std::optional<double> maxRelMse;
    std::optional<double> maxEnergyError;
};

/// Adds the options to `command`. They are in `options` once the command line has been parsed and `finish` called.
class CompareOptionParser {
public:
    explicit CompareOptionParser(CLI::App& command);

    /// The options, checked. Throws UsageError naming the option and its value.
    CompareOptions finish() const;
    /// Those of --suite.
    const AccuracySuiteParser& suite() const { return suite_; }

private:
    AccuracySuiteParser suite_;
    CompareOptions options_;
    std::string metric_ = "auto";
    std::optional<double> peak_;
    std::optional<double> differenceRange_;
};

} // namespace nacre::app
