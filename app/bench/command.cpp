// `nacre bench`: the suites, and what can be done with their results.
#include "app/command.hpp"

#include "app/bench/conclusion.hpp"
#include "app/bench/diff.hpp"
#include "app/bench/markdown.hpp"
#include "app/bench/report.hpp"
#include "app/bench/results.hpp"
#include "app/bench/run.hpp"
#include "app/bench/suites.hpp"
#include "app/interruption.hpp"

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

/// Where the results go. A folder that was made for them is removed again unless it is kept.
class ResultsFolder {
public:
    explicit ResultsFolder(const Path& folder) : folder_(folder) {
        std::error_code error;
        isNew_ = std::filesystem::create_directories(folder, error);
        if (error) {
            throw std::runtime_error(folder.string() + ": cannot be made: " + error.message());
        }
        checkWritable(folder / "results.json");
    }
    ResultsFolder(const ResultsFolder&) = delete;
    ~ResultsFolder() {
        if (isNew_) {
            std::error_code ignored;
            std::filesystem::remove_all(folder_, ignored);
        }
    }
    void keep() { isNew_ = false; }

private:
    Path folder_;
    bool isNew_ = false;
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
        std::cerr << line << std::endl;
    };
    ResultsFolder folder(options.folder);
    renderer::Device device(options.device);
    say("making the scenes");
    const bench::Plan plan = suite.plan(options.suite);
    const bench::Results results = bench::runPlan(device, plan, options.suite, options.folder, say);
    writeText(options.folder / "results.json", bench::formatResults(results));
    folder.keep(); // what has been measured is not thrown away
    writeReport(results, options.folder);
    std::cout << bench::conclude(results) << '\n' << (options.folder / "report.html").string() << '\n';
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
        std::cout << bench::formatComparison(comparison) << std::flush;
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
        std::cout << bench::conclude(results) << '\n';
    });
}

void addMarkdown(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand("markdown", "A results.json as Markdown on standard output");
    command->footer("Examples:\n  nacre bench markdown nacre-bench-thesis/results.json > thesis.md");
    const auto file = std::make_shared<Path>();
    command->add_option("RESULTS", *file, "results.json")->required();
    command->callback([file] { std::cout << bench::formatMarkdown(bench::loadResults(*file)); });
}

} // namespace

void addBench(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bench", "Measure the techniques, and compare measurements");
    command->require_subcommand(1);
    command->footer(R"(Examples:
  nacre bench thesis --quick
  nacre bench pareto --scene model.glb -o results
  nacre bench diff old/results.json new/results.json)");
    for (const Suite& suite : suites) {
        addSuite(*command, suite);
    }
    addDiff(*command);
    addReport(*command);
    addMarkdown(*command);
}

} // namespace nacre::app
