// `nacre bench` as a user runs it: a suite from start to end, comparing runs, bad files, and the report in a browser.
#include "bench/results/results.hpp"
#include "running_nacre.hpp"
#include "scene/texture.hpp"
#include "schema.hpp"
#include "tests/support/bench_sample.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <set>
#include <thread>

namespace {

using namespace nacre;
using namespace nacre::test;
using bench::formatResults;
using bench::Results;

class BenchTest : public CommandTest {
protected:
    void write(const std::string& name, const Results& results) const {
        writeText(folder() / name, formatResults(results));
    }

    /// Runs Chromium on a file of the folder with more arguments; what it printed, then what it logged.
    std::pair<std::string, std::string> browse(const std::string& file, const std::string& arguments) const {
        const std::string quoted = '\'' + folder().string() + '\'';
        const std::string command =
            "cd " + quoted +
            " && chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run"
            " --disable-background-networking --disable-component-update --disable-sync --hide-scrollbars"
            " --user-data-dir=" +
            quoted + "/profile --enable-logging=stderr --virtual-time-budget=5000 " + arguments + " 'file://'" +
            quoted + "/" + file + " >browser.out 2>browser.log";
        EXPECT_EQ(std::system(command.c_str()), 0) << readText(folder() / "browser.log");
        return {readText(folder() / "browser.out"), readText(folder() / "browser.log")};
    }

    /// A scene that is made in no time. Returns the files.
    std::vector<std::string> writeCube() const {
        writeText(folder() / "cube.obj", cubeObj);
        writeText(folder() / "scene.json", R"({"models": [{"model": "cube.obj", "material": "skin"}]})");
        return files();
    }

    void makeReport() const {
        write("results.json", bench::sample::thesisResults());
        const bench::sample::Pictures pictures;
        std::filesystem::copy(pictures.path / "off.png", folder() / "off.png");
        std::filesystem::copy(pictures.path / "on.png", folder() / "on.png");
        const Outcome outcome = run({"bench", "report", "results.json"});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.error;
    }
};

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) {
        ++count;
    }
    return count;
}

TEST_F(BenchTest, NeedsASuite) {
    expectComplaint(run({"bench"}), 2, {"subcommand"});
    expectComplaint(run({"bench", "guess"}), 2, {"subcommand", "nacre bench --help"});
    expectComplaint(run({"bench", "diff", "old.json"}), 2, {"NEW"});
    expectComplaint(run({"bench", "effect", "--suite", "targets", "--techniques", "bank"}), 2,
                    {"--techniques requires another suite than targets"});
}

void waitUntilItSays(const RunningNacre& nacre, const std::string& text) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (nacre.error().find(text) == std::string::npos && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

// Ctrl-C while it measures: it ends by that signal, and leaves no folder.
TEST_F(BenchTest, AnInterruptedRunLeavesNothing) {
    const std::vector<std::string> before = writeCube();
    const RunningNacre bench({"bench", "pareto", "--quick", "--scene", "scene.json", "-o", "results"}, folder());
    waitUntilItSays(bench, "comparing with brute");
    EXPECT_TRUE(std::filesystem::exists(folder() / "results")) << bench.error();
    bench.send(SIGINT);
    EXPECT_EQ(bench.wait().exitCode, 128 + SIGINT);
    EXPECT_EQ(files(), before);
}

// A second run is told at once that it cannot have the folder, and what somebody else puts there is not the run's.
TEST_F(BenchTest, ARunKeepsItsFolderAndOnlyItsOwn) {
    std::vector<std::string> left = writeCube();
    const RunningNacre bench({"bench", "pareto", "--quick", "--scene", "scene.json", "-o", "both"}, folder());
    waitUntilItSays(bench, "making the scenes");
    expectComplaint(run({"bench", "pareto", "--quick", "-o", "both"}), 1, {"both", "another benchmark"});
    writeText(folder() / "both/other", "somebody's");
    waitUntilItSays(bench, "comparing with brute");
    bench.send(SIGTERM);
    EXPECT_EQ(bench.wait().exitCode, 128 + SIGTERM);
    left.insert(left.begin(), {"both", "both/other"});
    ASSERT_EQ(files(), left);
    EXPECT_EQ(readText(folder() / "both/other"), "somebody's");
}

TEST_F(BenchTest, DiffOfEqualRunsSucceeds) {
    write("old.json", bench::sample::thesisResults());
    const Outcome outcome = run({"bench", "diff", "old.json", "old.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_EQ(outcome.output, "the same within noise: 132 of 132 quantities\n");
}

TEST_F(BenchTest, DiffFailsWhenSomethingGotSlower) {
    Results slower = bench::sample::thesisResults();
    write("old.json", slower);
    slower.measurements[3].effect = bench::sample::times(2 * slower.measurements[3].effect.median);
    write("new.json", slower);
    const Outcome outcome = run({"bench", "diff", "old.json", "new.json"});
    expectComplaint(outcome, 1, {"new.json", "slower or less accurate"});
    EXPECT_NE(outcome.output.find("+100.0 %"), std::string::npos) << outcome.output;
}

TEST_F(BenchTest, DiffRefusesWhatItCannotRead) {
    write("old.json", bench::sample::thesisResults());
    writeText(folder() / "cut.json", readText(folder() / "old.json").substr(0, 5000));
    writeText(folder() / "other.json", "{\"layers\": []}");
    expectComplaint(run({"bench", "diff", "old.json", "cut.json"}), 1, {"cut.json", "parse error"});
    expectComplaint(run({"bench", "diff", "other.json", "old.json"}), 1, {"other.json", "not a benchmark result"});
    expectComplaint(run({"bench", "diff", "old.json", "none.json"}), 1, {"none.json"});
}

TEST_F(BenchTest, RefusesAFolderItCannotWriteTo) {
    writeText(folder() / "taken", "");
    expectComplaint(run({"bench", "pareto", "--quick", "-o", "taken"}), 1, {"taken"});
}

TEST_F(BenchTest, LeavesNothingWhenItFails) {
    const Outcome outcome = run({"bench", "pareto", "--quick", "--scene", "none.json", "-o", "out"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.error.find("nacre: none.json: cannot be read"), std::string::npos) << outcome.error;
    EXPECT_TRUE(files().empty());
    write("results.json", bench::sample::thesisResults()); // and none of its pictures
    expectComplaint(run({"bench", "report", "results.json"}), 1, {".png", "No such file"});
    EXPECT_EQ(files(), std::vector<std::string>{"results.json"});
}

TEST_F(BenchTest, ParetoOfASmallSceneIsComplete) {
    writeText(folder() / "large.obj", nacre::test::largeObj);
    writeText(folder() / "scene.json", R"({"models": [{"model": "large.obj", "material": "skin"}]})");
    const Outcome outcome = run({"bench", "pareto", "--quick", "--scene", "scene.json", "-o", "out"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.error;
    const std::string json = readText(folder() / "out/results.json");
    expectMatchesSchema(json, "benchmark.schema.json");
    const Results results = bench::parseResults(json, "results.json");
    std::set<std::string> techniques;
    for (const bench::Measurement& measurement : results.measurements) {
        techniques.insert(measurement.technique);
        ASSERT_TRUE(measurement.error) << measurement.id;
        EXPECT_GT(measurement.error->psnr, 15) << measurement.id;
        EXPECT_GT(measurement.effect.median, 0) << measurement.id;
        EXPECT_GT(measurement.passShare, 0.2) << measurement.id;
        EXPECT_LT(measurement.passShare, 5) << measurement.id; // of two frames, on a machine that does other work, too
        EXPECT_GT(measurement.copyBytes, 0u) << measurement.id;
    }
    EXPECT_EQ(techniques, (std::set<std::string>{"bank", "bank-surfaces", "burley", "separable", "thesis"}));
    EXPECT_FALSE(results.noiseFloors.empty());
    ASSERT_TRUE(results.notes && results.notes->size() == 1);
    EXPECT_NE(outcome.error.find("nacre: note: " + results.notes->front() + '\n'), std::string::npos) << outcome.error;
    EXPECT_TRUE(std::filesystem::exists(folder() / "out/results.csv"));
    EXPECT_TRUE(std::filesystem::exists(folder() / "out/report.html"));
}

// Tiny pictures: that every suite runs to its end and says what it should, not how fast anything is.
TEST_F(BenchTest, EffectTimesEverySceneBesideACopy) {
    const std::vector<std::string> tiny{"--size", "48x32", "--rounds", "1", "--warm-up", "0", "--csv", "effect.csv"};
    const auto effect = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"bench", "effect"});
        arguments.insert(arguments.end(), tiny.begin(), tiny.end());
        return run(arguments);
    };
    const Outcome scenes = effect({"--suite", "scenes", "--skip-unscattered", "both"});
    ASSERT_EQ(scenes.exitCode, 0) << scenes.error;
    for (const char* text :
         {"half floats", "plane 48x32 cover 100% footprint 20 px, 6 layers, 4 materials in blocks of 45", "1 materials",
          "cover 25%", "cover 0%", "spheres 48x32", "tilt 48x32", "thin 48x32", "copy ", "bank ", "bank skipping ",
          "bank again ", " n 20"}) {
        EXPECT_NE(scenes.output.find(text), std::string::npos) << text << '\n' << scenes.output;
    }
    const std::string csv = readText(folder() / "effect.csv");
    EXPECT_EQ(countOf(csv, "\n"), 1u + 8 * 4) << csv;
    EXPECT_EQ(countOf(csv, ",20,"), 8u * 4 + 3 * 4) << "samples, and the footprint of three planes";
    const Outcome layers =
        effect({"--suite", "layers", "--techniques", "separable", "--albedo", "post", "--shader-float16", "off"});
    ASSERT_EQ(layers.exitCode, 0) << layers.error;
    EXPECT_NE(layers.output.find("us per layer"), std::string::npos) << layers.output;
    const Outcome transmit = effect({"--suite", "transmit"});
    ASSERT_EQ(transmit.exitCode, 0) << transmit.error;
    EXPECT_NE(transmit.output.find("transmit again"), std::string::npos) << transmit.output;
}

TEST_F(BenchTest, EffectNamesTheOptionThatIsWrong) {
    expectComplaint(run({"bench", "effect", "--suite", "guess"}), 2, {"--suite", "guess", "held-out"});
    expectComplaint(run({"bench", "effect", "--techniques", "bank,magic"}), 2, {"--techniques", "magic", "separable"});
    expectComplaint(run({"bench", "effect", "--albedo", "pre"}), 2, {"--albedo", "pre", "preAndPost"});
    expectComplaint(run({"bench", "effect", "--skip-unscattered", "yes"}), 2, {"--skip-unscattered", "yes"});
    expectComplaint(run({"bench", "effect", "--rounds", "0"}), 2, {"--rounds", "0"});
    expectComplaint(run({"bench", "effect", "--size", "48"}), 2, {"--size", "48", "WIDTHxHEIGHT"});
    expectComplaint(run({"bench", "effect", "--csv", "none/effect.csv"}), 1, {"none/effect.csv", "cannot be written"});
    expectComplaint(run({"bench", "shaders", "--technique", "magic"}), 2, {"--technique", "magic", "transmit"});
    EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(BenchTest, ContextTimesEveryTechnique) {
    const Outcome outcome =
        run({"bench", "context", "--size", "48x32", "--contexts", "1", "--techniques", "bank,separable"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_EQ(outcome.output.find("technique,first_ms,cached_median_ms,cached_p5_ms,cached_p95_ms\nbank,"), 0u)
        << outcome.output;
    EXPECT_NE(outcome.output.find("\nseparable,"), std::string::npos) << outcome.output;
}

TEST_F(BenchTest, ReportOpensInABrowserWithEverythingDrawn) {
    makeReport();
    const auto [page, log] = browse("report.html", "--dump-dom");
    EXPECT_EQ(countOf(log, "CONSOLE"), 0u) << log;
    EXPECT_NE(page.find("data-drawn=\"3\""), std::string::npos) << "the script did not reach its end";
    EXPECT_EQ(countOf(page, "<canvas"), 3u);
    EXPECT_NE(page.find("data-pictures=\"2\""), std::string::npos) << "a picture of the pair cannot be shown";
}

TEST_F(BenchTest, ReportIsLegibleAt1280Pixels) {
    makeReport();
    const std::string dom = browse("report.html", "--window-size=1280,2000 --dump-dom").first;
    EXPECT_NE(dom.find("data-cut-tables=\"0\""), std::string::npos) << "a table is wider than the page";
    browse("report.html", "--window-size=1280,2000 --screenshot=page.png");
    const scene::Texture page = scene::readTexture(folder() / "page.png", true);
    ASSERT_EQ(page.width, 1280u);
    // Ink of the plots' lines, in the colours of the first two techniques, and of text near the right-hand side.
    std::size_t blue = 0;
    std::size_t vermilion = 0;
    std::size_t dark = 0;
    for (std::size_t i = 0; i < page.pixels.size(); i += 4) {
        const int red = page.pixels[i];
        const int green = page.pixels[i + 1];
        const int other = page.pixels[i + 2];
        blue += red < 20 && std::abs(green - 114) < 20 && std::abs(other - 178) < 20 ? 1 : 0;
        vermilion += std::abs(red - 213) < 20 && std::abs(green - 94) < 20 && other < 20 ? 1 : 0;
        dark += red < 60 && green < 60 && other < 60 ? 1 : 0;
    }
    EXPECT_GT(blue, 2000u);
    EXPECT_GT(vermilion, 2000u);
    EXPECT_GT(dark, 10000u);
    // Nothing is wider than the page: its last columns are paper.
    for (std::uint32_t y = 0; y < page.height; ++y) {
        ASSERT_GT(page.pixels[4 * (std::size_t{y} * page.width + 1270)], 240) << "row " << y;
    }
}

TEST_F(BenchTest, OnePlotCanStandAlone) {
    makeReport();
    const std::string page = browse("report.html#plot-1", "--dump-dom").first;
    EXPECT_EQ(countOf(page, "<canvas"), 1u);
    EXPECT_NE(page.find(">experiment 2: 1920x1080</h3>"), std::string::npos) << page;
}

TEST_F(BenchTest, ReportPrints) {
    makeReport();
    browse("report.html", "--print-to-pdf=page.pdf --no-pdf-header-footer");
    EXPECT_EQ(readText(folder() / "page.pdf").substr(0, 5), "%PDF-");
    EXPECT_GT(std::filesystem::file_size(folder() / "page.pdf"), 20'000u);
}

} // namespace
