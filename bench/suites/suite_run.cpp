#include "bench/suites/suite_run.hpp"

#include "bench/machine.hpp"
#include "bench/results/series_fits.hpp"
#include "bench/suites/configuration_stage.hpp"
#include "commit.h"
#include "image/image_file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <span>
#include <thread>

namespace nacre::bench {
namespace {

constexpr std::uint32_t pictureShadowMapSize = 2048;

HarnessSettings settingsFor(bool quick) {
    if (quick) {
        return {
            .warmUpFrames = 1, .warmUpSeconds = 0, .rounds = 6, .frameRounds = 1, .effectsPerTurn = 1, .settle = false};
    }
    return {};
}

/// Splits the time that is left between this series and those after it by their numbers of configurations.
double secondsFor(std::span<const Series> series, double secondsLeft) {
    std::size_t configurations = 0;
    for (const Series& next : series) {
        configurations += next.configurations.size();
    }
    return secondsLeft * static_cast<double>(series.front().configurations.size()) /
           static_cast<double>(configurations);
}

std::string now() {
    const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
    return text;
}

Machine describe(const renderer::DeviceDescription& device) {
    return {.device = device.name,
            .kind = device.kind,
            .driver = device.driver,
            .apiVersion = device.apiVersion,
            .processor = processorName(),
            .threads = std::thread::hardware_concurrency(),
            .clocks = {}};
}

ImagePair render(Stage& stage, const Picture& picture, const std::filesystem::path& folder) {
    Configuration configuration{.effect = picture.before,
                                .view = picture.view,
                                .size = picture.size,
                                .shadowMapSize = pictureShadowMapSize,
                                .materials = picture.materials};
    const auto renderTo = [&](const Configuration& which, const std::string& file) {
        stage.select(which);
        stage.renderFrame();
        writeJpeg(folder / file, stage.read(renderer::Output::Color));
        return file;
    };
    Configuration after = configuration;
    after.effect = picture.after;
    const std::string beforeFile = renderTo(configuration, picture.name + "-before.jpg");
    const std::string afterFile = renderTo(after, picture.name + "-after.jpg");
    return {picture.series, picture.title, picture.beforeText, beforeFile, picture.afterText, afterFile};
}

std::vector<ImagePair> renderPictures(renderer::Device& device, const Plan& plan, const std::filesystem::path& folder,
                                      const Reporter& say) {
    std::vector<ImagePair> pairs;
    for (const Picture& picture : plan.pictures) {
        say("picture " + std::to_string(pairs.size() + 1) + " of " + std::to_string(plan.pictures.size()));
        Stage stage(device);
        pairs.push_back(render(stage, picture, folder));
    }
    return pairs;
}

} // namespace

Results runPlan(renderer::Device& device, const Plan& plan, const SuiteSettings& suite,
                const std::filesystem::path& folder, const Reporter& say) {
    const auto begin = std::chrono::steady_clock::now();
    HarnessSettings settings = settingsFor(suite.quick);
    const renderer::DeviceDescription& description = device.description();
    const auto clocks = [&] { return readClocks(description.name, description.kind == "software"); };
    Results results{.suite = plan.suite,
                    .nacreVersion = NACRE_VERSION,
                    .commit = std::string(commit),
                    .scene = plan.scene,
                    .notes = notesOf(plan),
                    .machine = describe(description)};
    for (std::size_t i = 0; i < plan.series.size(); ++i) {
        settings.secondsPerSeries = secondsFor(std::span(plan.series).subspan(i), suite.seconds - secondsSince(begin));
        SeriesResult result = measure(device, plan.series[i], settings, say);
        std::move(result.measurements.begin(), result.measurements.end(), std::back_inserter(results.measurements));
        std::move(result.noiseFloors.begin(), result.noiseFloors.end(), std::back_inserter(results.noiseFloors));
        if (results.machine.clocks.empty()) {
            results.machine.clocks = clocks();
        }
    }
    const std::vector<Clock> last = clocks();
    for (std::size_t i = 0; i < std::min(last.size(), results.machine.clocks.size()); ++i) {
        results.machine.clocks[i].after = last[i].before;
    }
    results.fits = fitSeries(results.measurements);
    results.images = renderPictures(device, plan, folder, say);
    results.created = now();
    results.procedure = {.quick = suite.quick,
                         .warmUpFrames = settings.warmUpFrames,
                         .repetitions = settings.rounds * settings.effectsPerTurn,
                         .seconds = secondsSince(begin)};
    return results;
}

} // namespace nacre::bench
