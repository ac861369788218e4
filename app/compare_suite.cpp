#include "app/compare_suite.hpp"

#include "app/command.hpp"
#include "app/interruption.hpp"
#include "app/reference_progress.hpp"
#include "app/terminal_text.hpp"
#include "bench/accuracy/accuracy_html.hpp"
#include "bench/accuracy/accuracy_json.hpp"
#include "bench/accuracy/accuracy_markdown.hpp"
#include "bench/accuracy/accuracy_text.hpp"

#include <iostream>
#include <optional>

namespace nacre::app {

namespace {

template <typename Items> void listNames(const char* what, const Items& items) {
    std::cout << what << '\n';
    for (const auto& item : items) {
        std::cout << "  " << item.name << std::string(item.name.size() < 18 ? 18 - item.name.size() : 1, ' ')
                  << item.what << '\n';
    }
}

void list(const AccuracySuiteOptions& options) {
    listNames("views", options.plan.views);
    listNames("techniques", options.plan.techniques);
    std::cout << "references\n  surface           the surface integral\n  walk              the random walk\n";
}

constexpr const char* pictureFolder = "pictures";

/// The folder, which is made where there is none, and the one of the pictures in it. Throws std::runtime_error naming
/// what cannot be written.
void makeFolders(const std::filesystem::path& output) {
    const std::filesystem::path pictures = output / pictureFolder;
    std::error_code error;
    std::filesystem::create_directories(pictures, error);
    if (!std::filesystem::is_directory(pictures)) {
        throw std::runtime_error(pictures.string() + ": cannot be made: " + error.message());
    }
    checkWritable(output / "accuracy.json");
    checkWritable(pictures / "test.png");
}

void writeResults(const std::filesystem::path& output, const bench::AccuracyResults& results) {
    std::string text;
    for (const bench::AccuracyViewResult& view : results.views) {
        text += bench::formatAccuracyText(view) + '\n';
    }
    writeText(output / "accuracy.txt", text);
    writeText(output / "accuracy.md", bench::formatAccuracyMarkdown(results));
    writeText(output / "accuracy.json", bench::formatAccuracyJson(results));
    writeText(output / "accuracy.html", bench::formatAccuracyHtml(results, pictureFolder));
}

void run(const AccuracySuiteOptions& options) {
    makeFolders(options.output);
    bench::AccuracyPlan plan = options.plan;
    plan.pictures = options.output / pictureFolder;
    renderer::Device device(options.device);
    std::optional<ReferenceProgress> progress;
    bench::AccuracyReporter reporter;
    reporter.say = [&](const std::string& line) {
        progress.reset();
        throwIfInterrupted();
        std::cerr << line << std::endl;
        progress.emplace(plan.stop);
    };
    reporter.proceed = [&](const reference::Progress& now) {
        progress->show(now);
        return !isInterrupted();
    };
    reporter.finished = [&](const bench::AccuracyViewResult& view) {
        progress.reset();
        std::cout << bench::formatAccuracyText(view) << std::endl;
    };
    writeResults(options.output, runAccuracy(device, plan, reporter));
    std::cout << printable((options.output / "accuracy.html").string()) << '\n';
}

} // namespace

void compareSuite(const AccuracySuiteOptions& options) {
    if (options.list) {
        list(options);
    } else {
        runInterruptibly([&] { run(options); });
    }
}

} // namespace nacre::app
