// `nacre reference`: a picture to measure others against, and the merging of its parts.
#include "app/command.hpp"
#include "app/interruption.hpp"
#include "app/progress.hpp"
#include "app/reference_options.hpp"
#include "app/reference_progress.hpp"
#include "app/reference_report.hpp"
#include "app/render_scene.hpp"
#include "app/terminal_text.hpp"
#include "image/image_file.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <iostream>

namespace nacre::app {

namespace {

using reference::Checkpoint;
using reference::Stopped;

constexpr std::chrono::seconds checkpointInterval{30};

/// The one place that knows how a film becomes a file.
void writeFilm(const std::filesystem::path& file, const reference::Film& film) {
    writeExr(file, {film.width, film.height, reference::channelNames(), reference::channelValues(film)});
}

const char* stoppedBy(Stopped stopped) {
    switch (stopped) {
    case Stopped::Spp:
        return "spp";
    case Stopped::Seconds:
        return "time";
    case Stopped::Noise:
        return "noise";
    case Stopped::Interrupted:
        break;
    }
    return "interruption";
}

void refuseToLoseCheckpoint(const ReferenceOptions& options) {
    const std::filesystem::path file = trace::checkpointOf(options.output);
    if (!options.resume && !options.restart && std::filesystem::exists(file)) {
        throw std::runtime_error(file.string() +
                                 ": is there from an earlier run; --resume goes on from it, --restart replaces it");
    }
}

void checkReferenceOutputs(const ReferenceOptions& options) {
    checkWritable(options.output);
    checkWritable(trace::checkpointOf(options.output));
    if (!options.json.empty()) {
        checkWritable(options.json);
    }
    refuseToLoseCheckpoint(options);
}

void readDirectLight(ReferenceOptions& options) {
    if (options.direct.empty()) {
        return;
    }
    nacre::Image image = readRadiance(options.direct);
    if (std::uint64_t{image.width} * options.height != std::uint64_t{image.height} * options.width) {
        throw std::runtime_error(options.direct.string() + ": is " + std::to_string(image.width) + "x" +
                                 std::to_string(image.height) + ", which is no picture of " +
                                 std::to_string(options.width) + "x" + std::to_string(options.height));
    }
    options.settings.direct = std::move(image);
}

void resumeFrom(const ReferenceOptions& options, reference::Reference& reference) {
    const std::filesystem::path file = trace::checkpointOf(options.output);
    if (!options.resume || !std::filesystem::exists(file)) {
        return;
    }
    Checkpoint checkpoint = reference::loadCheckpoint(file);
    trace::requireSameIdentity(file, checkpoint.identity, reference.identity());
    if (checkpoint.part != options.settings.part) {
        throw std::runtime_error(file.string() + ": is part " + std::to_string(checkpoint.part.index) + "/" +
                                 std::to_string(checkpoint.part.count) + ", not the --part asked for");
    }
    reference.resume(std::move(checkpoint.film));
}

/// Picture and checkpoint as they are now.
void save(const ReferenceOptions& options, const reference::Reference& reference) {
    reference::saveCheckpoint(trace::checkpointOf(options.output),
                              {reference.identity(), options.settings.part, reference.film()});
    writeFilm(options.output, reference.film());
}

Stopped runWithCheckpoints(const ReferenceOptions& options, reference::Reference& reference) {
    ReferenceProgress progress(options.stop);
    // The first time comes soon, so that there is something to look at.
    std::optional<std::chrono::steady_clock::time_point> saved;
    return reference.run(options.stop, [&](const reference::Progress& now) {
        progress.show(now);
        if (!saved || std::chrono::steady_clock::now() - *saved > checkpointInterval) {
            save(options, reference);
            saved = std::chrono::steady_clock::now();
        }
        return !isInterrupted();
    });
}

void summarise(const ReferenceResult& result) {
    const auto [least, most] = sppOf(result.checkpoint);
    std::cout << printable(result.file.string() + ": " + result.scene) << ", " << result.checkpoint.film.width << 'x'
              << result.checkpoint.film.height << ", " << least;
    if (most != least) {
        std::cout << " to " << most;
    }
    std::cout << " samples a pixel";
    const double noise = result.checkpoint.film.noise();
    if (std::isfinite(noise)) {
        std::cout << ", noise " << std::round(1e4 * noise) / 100 << " %";
    }
    std::cout << '\n';
}

void finish(const ReferenceResult& result, const std::filesystem::path& json) {
    for (const std::string& warning : result.warnings) {
        std::cerr << "nacre: warning: " << printable(warning) << '\n';
    }
    if (!json.empty()) {
        writeText(json, makeReport(result));
    }
    if (json != "-") {
        summarise(result);
        std::cout.flush();
    }
    printNotes(result.notes);
}

void compute(ReferenceOptions options) {
    checkReferenceOutputs(options);
    readDirectLight(options);
    const scene::Scene scene = [&] {
        const Progress progress("loading " + sceneName(options));
        return makeScene(options);
    }();
    requireInputsKept(options, scene, {options.output, options.json});
    const scene::Camera camera = makeCamera(options, scene);
    runInterruptibly([&] {
        reference::Reference reference(scene, camera, options.settings);
        resumeFrom(options, reference);
        const std::uint64_t samplesBefore = reference.film().sampleCount();
        const double secondsBefore = reference.film().seconds;
        const Stopped stopped = runWithCheckpoints(options, reference);
        save(options, reference);
        ReferenceResult result;
        result.checkpoint = {reference.identity(), options.settings.part, reference.film()};
        result.file = options.output;
        result.scene = sceneName(options);
        result.notes = scene.notes;
        result.stoppedBy = stoppedBy(stopped);
        result.seconds = reference.film().seconds - secondsBefore;
        const auto samples = static_cast<double>(reference.film().sampleCount() - samplesBefore);
        result.samplesPerSecond = result.seconds > 0 ? samples / result.seconds : 0;
        result.warnings = reference.warnings();
        finish(result, options.json);
        if (stopped == Stopped::Interrupted) {
            std::cout.flush();
            std::cerr << "nacre: interrupted; the same command with --resume goes on from "
                      << printable(trace::checkpointOf(options.output).string()) << '\n';
            throwIfInterrupted();
        }
    });
}

/// The checkpoint of a part that is named by its picture or by the checkpoint itself.
std::filesystem::path partCheckpoint(const std::filesystem::path& part) {
    return part.extension() == ".exr" ? trace::checkpointOf(part) : part;
}

struct MergeOptions {
    std::filesystem::path output;
    std::vector<std::filesystem::path> parts;
    std::filesystem::path json;
};

void mergeParts(const MergeOptions& options) {
    if (options.output.extension() != ".exr") {
        throw UsageError("OUT '" + options.output.string() + "' does not end in .exr");
    }
    std::vector<std::filesystem::path> files{options.output, options.json};
    std::vector<std::filesystem::path> checkpoints;
    for (const std::filesystem::path& part : options.parts) {
        files.push_back(part);
        checkpoints.push_back(partCheckpoint(part));
    }
    requireDistinctFiles(files);
    checkWritable(options.output);
    checkWritable(trace::checkpointOf(options.output));
    if (!options.json.empty()) {
        checkWritable(options.json);
    }
    ReferenceResult result;
    result.checkpoint = reference::merge(checkpoints);
    result.file = options.output;
    result.scene = std::to_string(options.parts.size()) + " parts";
    result.stoppedBy = "merge";
    reference::saveCheckpoint(trace::checkpointOf(options.output), result.checkpoint);
    writeFilm(options.output, result.checkpoint.film);
    finish(result, options.json);
}

void addMerge(CLI::App& reference) {
    CLI::App* command = reference.add_subcommand("merge", "Put the parts of a reference together");
    const auto options = std::make_shared<MergeOptions>();
    command->add_option("OUT", options->output, "FILE.exr")->required()->type_name("");
    command
        ->add_option("PARTS", options->parts,
                     "The parts' .exr files, their checkpoints beside them, or the checkpoints")
        ->required()
        ->type_name("");
    addJsonOption(*command, options->json);
    command->footer(R"(The result is to the last bit what one run without --part computes, and can be resumed as such.

Example:
  for i in 1 2 3; do nacre reference head.glb --spp 64 --part $i/3 -o part$i.exr; done
  nacre reference merge head.exr part1.exr part2.exr part3.exr)");
    command->callback([options] { mergeParts(*options); });
}

} // namespace

void addReference(CLI::App& app) {
    CLI::App* command = app.add_subcommand("reference", "Compute a picture to measure others against");
    const auto parser = std::make_shared<ReferenceOptionParser>(*command);
    addMerge(*command);
    command->callback([parser, command] {
        if (command->get_subcommands().empty()) {
            compute(parser->finish());
        }
    });
}

} // namespace nacre::app
