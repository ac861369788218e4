#include "bench/results/results_diff.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

namespace nacre::bench {
namespace {

// The largest floor that either run states. That of one configuration is too low between runs: there it was measured
// twice in one process, at one time and on one device.
double largestFloor(const Results& before, const Results& after) {
    double noise = 0;
    for (const Results* results : {&before, &after}) {
        for (const Measurement& measurement : results->measurements) {
            noise = std::max(noise, measurement.noise);
        }
    }
    return noise;
}

// A floor is the largest difference of a few pairs; of many more that differ as little, the largest is larger. Of n
// normal deviations it grows as √(2 ln n) (Cramér 1946, section 28.6).
double noiseBetween(const Results& before, const Results& after) {
    const double pairs = static_cast<double>(before.noiseFloors.size() + after.noiseFloors.size());
    const double compared = 2.0 * static_cast<double>(after.measurements.size()); // frame and effect
    const double growth = pairs >= 2 && compared > pairs ? std::sqrt(std::log(compared) / std::log(pairs)) : 1;
    return growth * largestFloor(before, after);
}

Change compareTime(const Measurement& before, const Measurement& after, const char* quantity,
                   Summary Measurement::*time, double noise) {
    return {.id = after.id,
            .quantity = quantity,
            .unit = "µs",
            .before = (before.*time).median,
            .after = (after.*time).median,
            .noise = noise,
            .verdict = compareTimes(before.*time, after.*time, noise)};
}

void compareMeasurements(const Measurement& before, const Measurement& after, double noise,
                         std::vector<Change>& changes) {
    changes.push_back(compareTime(before, after, "frame", &Measurement::frame, noise));
    changes.push_back(compareTime(before, after, "effect", &Measurement::effect, noise));
    if (before.error && after.error) {
        changes.push_back({.id = after.id,
                           .quantity = "PSNR",
                           .unit = "dB",
                           .before = before.error->psnr,
                           .after = after.error->psnr,
                           .noise = psnrNoise,
                           .verdict = comparePsnr(before.error->psnr, after.error->psnr, psnrNoise)});
    }
}

std::string findCaution(const Results& before, const Results& after) {
    if (before.machine.device != after.machine.device) {
        return "The devices differ (" + before.machine.device + ", then " + after.machine.device +
               "): times say nothing about the code.";
    }
    if (before.machine.driver != after.machine.driver) {
        return "The drivers differ (" + before.machine.driver + ", then " + after.machine.driver + ").";
    }
    return {};
}

std::size_t countOf(const Comparison& comparison, Verdict verdict) {
    return static_cast<std::size_t>(
        std::count_if(comparison.changes.begin(), comparison.changes.end(),
                      [verdict](const Change& change) { return change.verdict == verdict; }));
}

std::string format(const Change& change) {
    char text[160];
    if (change.unit == "dB") {
        std::snprintf(text, sizeof text, "%.2f dB, was %.2f dB (noise %.2f dB)", change.after, change.before,
                      change.noise);
    } else {
        const double percent = change.before > 0 ? 100 * (change.after / change.before - 1) : 0;
        std::snprintf(text, sizeof text, "%.1f µs, was %.1f µs: %+.1f %% (noise %.1f %%)", change.after, change.before,
                      percent, 100 * change.noise);
    }
    return "  " + change.id + ": " + change.quantity + " " + text + '\n';
}

void addList(std::string& text, const Comparison& comparison, Verdict verdict, const char* title) {
    const std::size_t count = countOf(comparison, verdict);
    if (count == 0) {
        return;
    }
    text += title;
    text += ": " + std::to_string(count) + '\n';
    for (const Change& change : comparison.changes) {
        if (change.verdict == verdict) {
            text += format(change);
        }
    }
}

void addList(std::string& text, const std::vector<std::string>& ids, const char* title) {
    if (ids.empty()) {
        return;
    }
    text += title;
    text += ": " + std::to_string(ids.size()) + '\n';
    for (const std::string& id : ids) {
        text += "  " + id + '\n';
    }
}

} // namespace

bool Comparison::regressed() const {
    return countOf(*this, Verdict::Worse) > 0;
}

Comparison compare(const Results& before, const Results& after) {
    Comparison comparison;
    comparison.caution = findCaution(before, after);
    const double noise = noiseBetween(before, after);
    std::map<std::string, const Measurement*> earlier;
    for (const Measurement& measurement : before.measurements) {
        earlier[measurement.id] = &measurement;
    }
    for (const Measurement& measurement : after.measurements) {
        const auto found = earlier.find(measurement.id);
        if (found == earlier.end()) {
            comparison.added.push_back(measurement.id);
            continue;
        }
        compareMeasurements(*found->second, measurement, noise, comparison.changes);
        earlier.erase(found);
    }
    if (comparison.changes.empty()) {
        throw std::invalid_argument("the two runs (suites \"" + before.suite + "\" and \"" + after.suite +
                                    "\") have no configuration in common");
    }
    for (const auto& [id, measurement] : earlier) {
        comparison.removed.push_back(id);
    }
    return comparison;
}

std::string formatComparison(const Comparison& comparison) {
    std::string text = comparison.caution.empty() ? "" : comparison.caution + '\n';
    addList(text, comparison, Verdict::Worse, "slower or less accurate");
    addList(text, comparison, Verdict::Better, "faster or more accurate");
    addList(text, comparison.removed, "no longer measured");
    addList(text, comparison.added, "measured for the first time");
    if (const std::size_t unknown = countOf(comparison, Verdict::Unknown); unknown > 0) {
        text += "measured too seldom to tell: " + std::to_string(unknown) + '\n';
    }
    text += "the same within noise: " + std::to_string(countOf(comparison, Verdict::Same)) + " of " +
            std::to_string(comparison.changes.size()) + " quantities\n";
    return text;
}

} // namespace nacre::bench
