// `nacre bench`: the suites, what can be done with their results, and times of the effect alone.
#include "app/command.hpp"
#include "app/interruption.hpp"
#include "app/render_scene.hpp"
#include "app/terminal_text.hpp"
#include "bench/effect/context_times.hpp"
#include "bench/effect/effect_suites.hpp"
#include "bench/effect/shader_statistics.hpp"
#include "bench/report/conclusion.hpp"
#include "bench/report/html_report.hpp"
#include "bench/report/markdown.hpp"
#include "bench/results/results.hpp"
#include "bench/results/results_diff.hpp"
#include "bench/results_folder.hpp"
#include "bench/suites/suite_run.hpp"
#include "bench/suites/suites.hpp"

#include <CLI/CLI.hpp>

#include <iostream>

namespace nacre::app {

namespace {

using Path = std::filesystem::path;

struct Suite {
    const char* name;
    const char* help;
    bench::Plan (*plan)(const bench::SuiteSettings& settings);
};

constexpr Suite suites[] = {
    {"thesis", "The thesis's three experiments: time against radius and layers", bench::makeThesisPlan},
    {"sweep", "Time against resolution, coverage, footprint, materials, layers, lights and triangles",
     bench::makeSweepPlan},
    {"pareto", "Error against time, of every technique at every quality", bench::makeParetoPlan}};

constexpr double maxSeconds = 86400;

struct SuiteOptions {
    bench::SuiteSettings suite;
    renderer::DeviceSettings device;
    Path folder;
};

/// The table and the report, neither of them unless both can be made.
void writeReport(const bench::Results& results, const Path& folder) {
    const std::string table = bench::formatCsv(results);
    const std::string report = bench::formatReport(results, folder);
    writeText(folder / "results.csv", table);
    writeText(folder / "report.html", report);
}

void runSuite(const Suite& suite, const SuiteOptions& options) {
    requireRange(options.suite.seconds, 1, maxSeconds, "--seconds");
    const auto say = [](const std::string& line) {
        throwIfInterrupted();
        std::cerr << printable(line) << std::endl;
    };
    bench::ResultsFolder folder(options.folder);
    checkWritable(options.folder / "results.json");
    renderer::Device device(options.device);
    say("making the scenes");
    const bench::Plan plan = suite.plan(options.suite);
    printNotes(bench::notesOf(plan));
    const std::string json = bench::formatResults(bench::runPlan(device, plan, options.suite, folder.draft(), say));
    writeText(folder.draft() / "results.json", json);
    folder.publish(); // what has been measured is not thrown away
    const bench::Results results = bench::parseResults(json, "results.json"); // as `nacre bench report` reads them
    writeReport(results, options.folder);
    std::cout << printableLines(bench::conclude(results)) << '\n'
              << printable((options.folder / "report.html").string()) << '\n';
}

void addSuite(CLI::App& bench, const Suite& suite) {
    CLI::App* command = bench.add_subcommand(suite.name, suite.help);
    const std::string example = "  nacre bench " + std::string(suite.name);
    command->footer("Examples:\n" + example + " --quick\n" + example + " --scene model.glb -o results");
    const auto options = std::make_shared<SuiteOptions>();
    options->folder = std::string("nacre-bench-") += suite.name;
    command->add_flag("--quick", options->suite.quick, "Smaller pictures and fewer frames: minutes without a GPU");
    command->add_option("--scene", options->suite.scene, "A model or scene file in place of the gallery")
        ->type_name("FILE");
    command
        ->add_option("--seconds", options->suite.seconds,
                     "Time for measuring; every configuration gets its least number of frames even so")
        ->type_name("N")
        ->capture_default_str();
    command
        ->add_option("-o,--output", options->folder, "Where to leave the results; default " + options->folder.string())
        ->type_name("FOLDER");
    command->add_option("--device", options->device.name, "The number or a part of the name of a Vulkan device")
        ->type_name("NAME");
    command->callback([&suite, options] { runInterruptibly([&] { runSuite(suite, *options); }); });
}

/// Options whose values bench reads; what it refuses is a mistake on the command line.
template <typename Parse> auto parsed(const Parse& parse) {
    try {
        return parse();
    } catch (const std::invalid_argument& error) {
        throw UsageError(error.what());
    }
}

/// What `nacre bench effect` was given, as text.
struct EffectArguments {
    std::string suite = "all";
    std::string techniques;
    std::string size = "1920x1080";
    std::string halfFloats = "on";
    std::string skipUnscattered = "off";
    std::string albedo = "off";
    std::string lightFormat = "half";
    Path csv = "nacre-bench-effect.csv";
    bench::GpuTimingSettings timing;
    renderer::DeviceSettings device;
};

bench::EffectTimingOptions makeEffectOptions(const EffectArguments& arguments) {
    return parsed([&] {
        const PictureSize size = parseSize(arguments.size);
        requireRange(arguments.timing.rounds, 1, 1e6, "--rounds");
        requireRange(arguments.timing.warmUpMilliseconds, 0, 1e6, "--warm-up");
        return bench::EffectTimingOptions{
            .suite = arguments.suite,
            .extent = {size.width, size.height},
            .techniques = bench::parseTechniques(arguments.techniques),
            .timing = arguments.timing,
            .halfFloats = bench::parseHalfFloats(arguments.halfFloats),
            .skipUnscattered = bench::parseSkipUnscattered(arguments.skipUnscattered),
            .albedo = bench::parseAlbedo(arguments.albedo),
            .lightFormat = bench::parseLightFormat(arguments.lightFormat),
        };
    });
}

void runEffect(const EffectArguments& arguments) {
    const bench::EffectTimingOptions options = makeEffectOptions(arguments);
    checkWritable(arguments.csv);
    renderer::Device device(arguments.device);
    const auto say = [](const std::string& line) { std::cerr << line << std::endl; };
    writeText(arguments.csv, bench::formatEffectCsv(bench::runEffectSuite(device, options, say, std::cout)));
}

void addDevice(CLI::App& command, std::string& name) {
    command.add_option("--device", name, "The number or a part of the name of a Vulkan device")->type_name("NAME");
}

void addEffect(CLI::App& bench) {
    CLI::App* command =
        bench.add_subcommand("effect", "GPU times of the techniques on synthetic scenes, beside a copy");
    command->footer(R"(Each configuration takes its turn once a round: 20 steady repeats and 5 lone frames. The suites:
  scenes     planes (two in blocks of materials, one of one material, 25 % cover, nothing), spheres, slopes, thin bars
  held-out   a floor, terrain, boxes, a sheet with holes before another, leaves, strands of hair
  targets    planes and edges at footprints of 6, 20 and 60 px, also at twice the size
  footprint, layers, materials   one quantity varies, with the line through its times
  transmit   transmission of three lights
The techniques are measured in turn on every scene; the first of them twice, whose difference is the noise floor.

Examples:
  nacre bench effect --suite scenes
  nacre bench effect --suite scenes --techniques bank,burley --size 3840x2160 --csv burley.csv)");
    const auto arguments = std::make_shared<EffectArguments>();
    const auto add = [&](const char* option, auto& value, const char* help, const char* type) {
        return command->add_option(option, value, help)->type_name(type)->capture_default_str();
    };
    add("--suite", arguments->suite, "What to measure", "NAME")->check(CLI::IsMember(bench::effectSuiteNames()));
    add("--techniques", arguments->techniques,
        "Of scenes and held-out (bank), of footprint, layers and materials (all); targets has its own", "A,B,...");
    add("--size", arguments->size, "Pixels", "WIDTHxHEIGHT");
    add("--rounds", arguments->timing.rounds, "Turns of each configuration", "N");
    add("--warm-up", arguments->timing.warmUpMilliseconds, "Of each configuration before the first round", "MS");
    add("--shader-float16", arguments->halfFloats, "Half floats where the device has them: on or off", "X");
    add("--skip-unscattered", arguments->skipUnscattered,
        "Leave pixels without a material as they are: on, off or both", "X");
    add("--albedo", arguments->albedo, "Give scatter 8-bit albedo, used so: off, post or preAndPost", "X");
    add("--light-format", arguments->lightFormat,
        "Of scatter's irradiance and output: half (R16G16B16A16_SFLOAT) or packed (B10G11R11_UFLOAT_PACK32)", "FORMAT");
    add("--csv", arguments->csv, "Where all figures go", "FILE");
    addDevice(*command, arguments->device.name);
    command->callback([arguments, command] {
        if (arguments->suite == "targets" || arguments->suite == "transmit") {
            requireWith(*command, {"--techniques"}, "another suite than " + arguments->suite + ", which has its own");
        }
        runEffect(*arguments);
    });
}

void addContext(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand("context", "How long a context of the effect takes to make, as CSV");
    command->footer(
        R"(Nearly all of the first time is the driver's compiler. What a driver has compiled before it reads from the disk, unless
__GL_SHADER_DISK_CACHE=0 (NVIDIA) or MESA_SHADER_CACHE_DISABLE=1 (Mesa) is set.

Examples:
  __GL_SHADER_DISK_CACHE=0 nacre bench context)");
    struct Arguments {
        std::string size = "1920x1080";
        std::uint32_t contexts = 9;
        std::string techniques;
        renderer::DeviceSettings device;
    };
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("--size", arguments->size, "Largest picture, pixels")
        ->type_name("WIDTHxHEIGHT")
        ->capture_default_str();
    command->add_option("--contexts", arguments->contexts, "How many more to make, with a pipeline cache")
        ->type_name("N")
        ->capture_default_str();
    command->add_option("--techniques", arguments->techniques, "In place of all")->type_name("A,B,...");
    addDevice(*command, arguments->device.name);
    command->callback([arguments] {
        const PictureSize size = parseSize(arguments->size);
        requireRange(arguments->contexts, 1, 1e6, "--contexts");
        const auto asked = parsed([&] { return bench::parseTechniques(arguments->techniques); });
        renderer::Device device(arguments->device);
        std::cerr << device.description().name << ", " << device.description().driver << std::endl;
        std::cout << bench::contextCsvHeader();
        for (const NacreTechnique technique : asked.empty() ? bench::scatterTechniques() : asked) {
            std::cout << bench::formatContextCsv(
                             bench::measureContext(device, technique, {size.width, size.height}, arguments->contexts))
                      << std::flush;
        }
    });
}

void addShaders(CLI::App& bench) {
    CLI::App* command =
        bench.add_subcommand("shaders", "What the driver's compiler says of the effect's passes: registers, spills");
    command->footer(
        R"(Nothing is dispatched. The driver must offer VK_KHR_pipeline_executable_properties. Mesa compiles for AMD devices that
are not there: RADV_FORCE_FAMILY=navi21 and its RADV alone in VK_DRIVER_FILES.

Examples:
  nacre bench shaders --technique bank
  nacre bench shaders --csv shaders.csv)");
    struct Arguments {
        std::string technique = "all";
        Path csv;
        std::string device;
    };
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("--technique", arguments->technique, "A technique's name, transmit or all")
        ->type_name("NAME")
        ->capture_default_str();
    command->add_option("--csv", arguments->csv, "Where all figures go")->type_name("FILE");
    command->add_option("--device", arguments->device, "A part of the name of a Vulkan device")->type_name("NAME");
    command->callback([arguments] {
        if (!arguments->csv.empty()) {
            checkWritable(arguments->csv);
        }
        const auto passes =
            parsed([&] { return bench::compilePasses(arguments->technique, arguments->device, std::cout); });
        if (!arguments->csv.empty()) {
            writeText(arguments->csv, bench::formatShaderCsv(passes));
        }
    });
}

void addDiff(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand("diff", "What got slower or less accurate between two runs");
    command->footer(R"(Ends with 1 when anything did, beyond the noise floor that the runs state.

Examples:
  nacre bench diff old/results.json new/results.json)");
    const auto files = std::make_shared<std::pair<Path, Path>>();
    command->add_option("OLD", files->first, "results.json of the earlier run")->required();
    command->add_option("NEW", files->second, "results.json of the later run")->required();
    command->callback([files] {
        const bench::Comparison comparison =
            bench::compare(bench::loadResults(files->first), bench::loadResults(files->second));
        std::cout << printableLines(bench::formatComparison(comparison)) << std::flush;
        if (comparison.regressed()) {
            throw std::runtime_error(files->second.string() + ": slower or less accurate than " +
                                     files->first.string());
        }
    });
}

void addReport(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand("report", "Write the report and the table of a results.json again");
    command->footer("Examples:\n  nacre bench report nacre-bench-thesis/results.json");
    const auto file = std::make_shared<Path>();
    command->add_option("RESULTS", *file, "results.json, its pictures beside it")->required();
    command->callback([file] {
        const Path folder = file->has_parent_path() ? file->parent_path() : ".";
        const bench::Results results = bench::loadResults(*file);
        writeReport(results, folder);
        std::cout << printableLines(bench::conclude(results)) << '\n';
    });
}

void addMarkdown(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand("markdown", "A results.json as Markdown on standard output");
    command->footer("Examples:\n  nacre bench markdown nacre-bench-thesis/results.json > thesis.md");
    const auto file = std::make_shared<Path>();
    command->add_option("RESULTS", *file, "results.json")->required();
    command->callback([file] { std::cout << printableLines(bench::formatMarkdown(bench::loadResults(*file))); });
}

} // namespace

void addBench(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bench", "Measure the techniques, and compare measurements");
    command->require_subcommand(1);
    command->footer(R"(Examples:
  nacre bench thesis --quick
  nacre bench pareto --scene model.glb -o results
  nacre bench effect --suite scenes
  nacre bench diff old/results.json new/results.json)");
    for (const Suite& suite : suites) {
        addSuite(*command, suite);
    }
    addEffect(*command);
    addContext(*command);
    addShaders(*command);
    addDiff(*command);
    addReport(*command);
    addMarkdown(*command);
}

} // namespace nacre::app
