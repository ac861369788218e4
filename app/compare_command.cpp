// `nacre compare`: how far one picture is from another.
#include "app/command.hpp"
#include "app/compare_report.hpp"
#include "app/compare_suite.hpp"
#include "app/progress.hpp"
#include "app/terminal_text.hpp"
#include "image/false_color.hpp"
#include "image/image_file.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

namespace nacre::app {

namespace {

void checkOutputs(const CompareOptions& options) {
    for (const std::filesystem::path& file : {options.difference, options.heat, options.json}) {
        if (!file.empty()) {
            checkWritable(file);
        }
    }
}

double largestDifference(const Comparison& comparison) {
    double largest = 0;
    for (std::size_t i = 0; i < comparison.test.values.size(); ++i) {
        largest = std::max(largest, std::abs(double{comparison.test.values[i]} - comparison.reference.values[i]));
    }
    return largest;
}

std::string fourDigits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

/// One sentence that names every bound that does not hold.
void failOnBounds(const CompareOptions& options, const std::vector<BoundCheck>& checks) {
    std::string sentence;
    for (const BoundCheck& check : checks) {
        if (!check.holds) {
            sentence += (sentence.empty() ? "" : ", and ") + check.option + ' ' + fourDigits(check.bound) +
                        " does not hold: it is " + fourDigits(check.value);
        }
    }
    if (!sentence.empty()) {
        throw std::runtime_error(options.test.string() + ": " + sentence);
    }
}

void compare(const CompareOptions& options) {
    checkOutputs(options);
    const CompareInputs inputs = readInputs(options);
    const Comparison comparison = [&] {
        const Progress progress("comparing " + options.test.string());
        return compareImages(inputs.test, inputs.reference, inputs.settings);
    }();
    double range = options.differenceRange;
    if (!options.difference.empty()) {
        const double largest = largestDifference(comparison);
        range = range > 0 ? range : largest > 0 ? largest : 1; // grey where nothing differs
        writePng(options.difference, signedDifference(comparison.test, comparison.reference, range));
    }
    if (!options.heat.empty()) {
        writePng(options.heat, heatMap(comparison.flipMap));
    }
    const std::vector<BoundCheck> bounds = checkBounds(options, comparison);
    if (!options.json.empty()) {
        writeText(options.json, makeComparisonReport(options, inputs, comparison, bounds, range));
    }
    if (options.json != "-") {
        std::cout << printableLines(describeComparison(options, inputs, comparison));
    }
    failOnBounds(options, bounds);
}

} // namespace

void addCompare(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("compare", "Say how far a picture is from another, or techniques from references");
    const auto parser = std::make_shared<CompareOptionParser>(*command);
    command->callback([parser] {
        if (parser->suite().isAsked()) {
            compareSuite(parser->suite().finish());
        } else {
            compare(parser->finish());
        }
    });
}

} // namespace nacre::app
