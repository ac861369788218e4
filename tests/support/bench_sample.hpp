// Synthetic benchmark results with known slopes.
#pragma once

#include "bench/results/results.hpp"
#include "bench/results/series_fits.hpp"
#include "image/image_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <string>

namespace nacre::bench::sample {

inline Summary times(double median) {
    return {.count = 100,
            .median = median,
            .p5 = 0.97 * median,
            .p95 = 1.1 * median,
            .low = 0.995 * median,
            .high = 1.005 * median,
            .confidence = 0.9648};
}

/// Mpx
inline double pixels(std::uint32_t width, std::uint32_t height) {
    return 1e-6 * width * height;
}

inline Measurement measure(const std::string& series, const std::string& technique, std::uint32_t width,
                           std::uint32_t height, const std::string& variable, const std::string& unit, double value,
                           double effect) {
    const double area = pixels(width, height);
    return {.id = series + '/' + technique + '/' + std::to_string(height) + '/' + std::to_string(value),
            .series = series,
            .view = "gallery, front",
            .technique = technique,
            .width = width,
            .height = height,
            .variable = variable,
            .unit = unit,
            .value = value,
            .frame = times(400 + effect),
            .effect = times(effect),
            .copy = times(8 * area),
            .recording = times(40),
            .passes = {{"shadow maps", times(300)},
                       {"G-buffer", times(100)},
                       {"scatter: reduce", times(0.4 * effect)},
                       {"scatter: combine", times(0.6 * effect)}},
            .passShare = 0.99,
            .copyBytes = static_cast<std::uint64_t>(22e6 * area),
            .coverage = 0.41,
            .footprint = 12.5,
            .triangles = 436'508,
            .lights = 3,
            .materials = 5,
            .layers = 10,
            .dispatches = 10,
            .memory = {{"G-buffer", static_cast<std::uint64_t>(40e6 * area)}},
            .noise = 0.01};
}

/// µs per texel and Mpx.
inline double slopeOf(const std::string& technique) {
    return technique == "thesis" ? 10 : technique == "thesis-baked" ? 8 : 0;
}

inline Results emptyResults(const std::string& suite) {
    return {.suite = suite,
            .nacreVersion = "0.1.0",
            .commit = "0123abc",
            .created = "2026-01-02T03:04:05Z",
            .scene = "gallery",
            .machine = {"A device", "discrete", "driver 1", "1.3.0", "A processor", 8, {{"graphics", 1980, 1965}}},
            .procedure = {.quick = false, .warmUpFrames = 3, .repetitions = 100, .seconds = 12.5}};
}

/// Experiment 2 for three techniques: two that are proportional to radius and pixels, and one that is flat.
inline Results thesisResults() {
    Results results = emptyResults("thesis");
    for (const std::uint32_t height : {720u, 1080u}) {
        const std::uint32_t width = height * 16 / 9;
        for (const char* technique : {"thesis", "thesis-baked", "bank"}) {
            for (int radius = 3; radius <= 13; ++radius) {
                const double slope = slopeOf(technique) * pixels(width, height);
                const double wobble = radius % 2 == 0 ? 1.001 : 0.999;
                const double effect = slope > 0 ? slope * radius * wobble : 60 * wobble;
                results.measurements.push_back(
                    measure("experiment 2", technique, width, height, "radius", "texels", radius, effect));
            }
        }
    }
    results.noiseFloors.push_back({results.measurements[0].id, "experiment 2", times(100), times(101), 0.01});
    results.images = {{"experiment 2", "Figure 4.4: head", "effect off", "off.png", "effect on", "on.png"}};
    results.fits = fitSeries(results.measurements);
    return results;
}

/// Two views with six settings, of which only separable's cheapest and bank are worth having.
inline Results paretoResults() {
    Results results = emptyResults("pareto");
    const struct {
        const char* technique;
        double taps, time, psnr;
    } settings[] = {{"separable", 11, 30, 30}, {"separable", 25, 90, 36}, {"separable", 41, 150, 38},
                    {"burley", 16, 70, 33},    {"burley", 64, 200, 44.5}, {"bank", 1, 60, 50}};
    for (const char* view : {"head", "dragon"}) {
        for (const auto& setting : settings) {
            Measurement measurement =
                measure(std::string("pareto, ") + view, setting.technique, 1920, 1080, "taps", "taps", setting.taps,
                        setting.time * (view == std::string("head") ? 1 : 4));
            measurement.view = view;
            measurement.error = ImageError{.psnr = setting.psnr, .relMse = 0.001, .energyRatio = 1};
            results.measurements.push_back(measurement);
        }
    }
    return results;
}

/// The pictures that thesisResults names, in a folder of their own for as long as this lives: a ramp, and the same in
/// red.
struct Pictures : tests::TemporaryFolder {
    Pictures() {
        constexpr std::uint32_t width = 320;
        constexpr std::uint32_t height = 180;
        Image ramp = makeImage(width, height, {"R", "G", "B"}, Encoding::Srgb);
        for (std::size_t i = 0; i < ramp.values.size(); ++i) {
            ramp.values[i] = static_cast<float>(i / 3 % width) / width;
        }
        Image red = ramp;
        for (std::size_t i = 0; i < red.values.size(); i += 3) {
            red.values[i] = 1;
        }
        writePng(path / "off.png", ramp);
        writePng(path / "on.png", red);
    }
};

} // namespace nacre::bench::sample
