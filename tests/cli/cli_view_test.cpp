// `nacre view`: frames without a window, turntables, and scripts that drive the window.
#include "image/image_file.hpp"
#include "running_nacre.hpp"
#include "schema.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

namespace {

using nacre::test::CommandTest;
using nacre::test::cubeObj;
using nacre::test::Environment;
using nacre::test::expectComplaint;
using nacre::test::Outcome;
using nacre::test::readText;
using nacre::test::writeText;
using Json = nlohmann::json;

/// A display without a screen, for as long as the object lives.
class Display {
public:
    Display() : pipe_(popen("echo $$; exec Xvfb -displayfd 1 -screen 0 1000x800x24 2>/dev/null", "r")) {
        if (pipe_ == nullptr || std::fscanf(pipe_, "%d %d", &process_, &number_) != 2) {
            number_ = -1;
        }
    }
    ~Display() {
        if (process_ > 0) {
            kill(process_, SIGTERM);
        }
        if (pipe_ != nullptr) {
            pclose(pipe_);
        }
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    bool isThere() const { return number_ >= 0; }
    std::string name() const { return ":" + std::to_string(number_); }

private:
    FILE* pipe_;
    int process_ = 0;
    int number_ = -1;
};

class ViewTest : public CommandTest {
protected:
    void SetUp() override { writeText(folder() / "cube.obj", cubeObj); }

    Outcome runScript(const Json& steps, const Environment& platform) const {
        writeText(folder() / "script.json", Json{{"size", {500, 300}}, {"samples", 2}, {"steps", steps}}.dump());
        return run({"view", "cube.obj", "--material", "skin", "--script", "script.json", "--validation"},
                   environmentOf(platform));
    }

    /// Settings and recovery files are in the test's folder.
    Environment environmentOf(const Environment& platform) const {
        Environment environment = platform;
        for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_RUNTIME_DIR"}) {
            environment.emplace_back(name, folder().string());
        }
        return environment;
    }

    std::string bytes(const std::string& file) const { return readText(folder() / file); }
};

/// Qt without a display: frames are drawn and not shown.
const Environment offscreen{{"QT_QPA_PLATFORM", "offscreen"}};

TEST_F(ViewTest, HeadlessSaysWhatFramesTakeWithLightsStillAndMoving) {
    const Outcome outcome = run({"view", "cube.obj", "--material", "skin", "--headless", "--frames", "3", "--size",
                                 "32x18", "--shadow-map-size", "64", "--json", "frames.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    for (const char* part :
         {"32x18, 3 frames", "lights still", "lights moving", "material changing", "device allocations",
          "scatter and transmit, device", "frame, processor", "p99", "G-buffer"}) {
        EXPECT_NE(outcome.output.find(part), std::string::npos) << part << "\n" << outcome.output;
    }
    nacre::test::expectMatchesSchema(bytes("frames.json"), "view.schema.json");
    const Json report = Json::parse(bytes("frames.json"));
    ASSERT_EQ(report.at("runs").size(), 3u);
    for (const Json& run : report.at("runs")) {
        EXPECT_EQ(run.at("deviceAllocations"), 0) << run;
        EXPECT_EQ(run.at("waits"), 0) << run;
    }
}

TEST_F(ViewTest, AReportNamesAFileWhoseNameIsNotUtf8) {
    std::filesystem::copy_file(folder() / "cube.obj", folder() / "w\xfcrfel.obj");
    const Outcome outcome = run({"view", "w\xfcrfel.obj", "--headless", "--frames", "2", "--moving", "nothing",
                                 "--size", "32x18", "--shadow-map-size", "64", "--json", "frames.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_EQ(Json::parse(bytes("frames.json")).at("scene").at("name"), "w\ufffdrfel.obj");
}

TEST_F(ViewTest, ATurntablesFrameIsTheSameWhoeverDrawsIt) {
    const auto turntable = [&](const std::string& frames, const std::string& output) {
        const Outcome outcome = run({"view", "cube.obj", "--material", "wax", "--turntable", "3", "--frames", frames,
                                     "-o", output, "--size", "32x18", "--samples", "2", "--shadow-map-size", "64"});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    };
    turntable("0:2", "all");
    turntable("2:2", "last");
    EXPECT_EQ(bytes("all/0002.png"), bytes("last/0002.png"));
    EXPECT_NE(bytes("all/0002.png"), bytes("all/0001.png"));
    EXPECT_FALSE(std::filesystem::exists(folder() / "last/0001.png"));
}

TEST_F(ViewTest, WrongRangesAreRefused) {
    expectComplaint(run({"view", "--turntable", "3", "-o", "x", "--frames", "2:3"}), 2, {"--frames 2:3", "0 to 2"});
    expectComplaint(run({"view", "--turntable", "3"}), 2, {"-o DIR"});
    expectComplaint(run({"view", "--headless", "--frames", "many"}), 2, {"--frames 'many'"});
}

TEST_F(ViewTest, OptionsOfAnotherWayToViewAreRefused) {
    const auto refused = [&](std::vector<std::string> arguments, const char* sentence) {
        arguments.insert(arguments.begin(), "view");
        expectComplaint(run(arguments), 2, {sentence});
    };
    refused({"--json", "frames.json"}, "--json requires --headless");
    refused({"--turntable", "3", "-o", "x", "--moving", "lights"}, "--moving requires --headless");
    refused({"--headless", "-o", "x"}, "--output requires --turntable");
    refused({"--headless", "--samples", "2"}, "--samples requires --turntable");
    refused({"--size", "64x64"}, "--size requires --headless or --turntable");
    refused({"--headless", "--script", "steps.json"}, "--script requires a window");
    refused({"--turntable", "0", "-o", "x"}, "--turntable 0 is outside 1 to 100000");
    refused({"--headless", "--turntable", "3"}, "--headless and --turntable exclude each other");
}

#ifdef NACRE_HAS_WINDOW

TEST_F(ViewTest, AScriptEditsUndoesSavesAndLoads) {
    const Outcome outcome = runScript({{{"wait", true}},
                                       {{"picture", "before.png"}},
                                       {{"set", "material.scale"}, {"value", 6}},
                                       {{"wait", true}},
                                       {{"picture", "scaled.png"}},
                                       {{"saveMaterial", "scaled.json"}},
                                       {{"action", "edit.undo"}},
                                       {{"wait", true}},
                                       {{"picture", "undone.png"}},
                                       {{"click", "layers.add"}},
                                       {{"select", "layers"}, {"row", 0}, {"checked", false}},
                                       {{"wait", true}},
                                       {{"picture", "layers.png"}},
                                       {{"loadMaterial", "scaled.json"}},
                                       {{"wait", true}},
                                       {{"picture", "loaded.png"}},
                                       {{"panel", "Compare"}},
                                       {{"choose", "compare.second"}, {"item", "Effect off"}},
                                       {{"choose", "compare.mode"}, {"item", "A and B, divided"}},
                                       {{"wait", true}},
                                       {{"expect", "compare.error"}, {"text", "FLIP"}},
                                       {{"expect", "compare.error"}, {"text", "Light, A over B: red"}},
                                       {{"screenshot", "window.png"}}},
                                      offscreen);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_NE(bytes("before.png"), bytes("scaled.png"));
    EXPECT_EQ(bytes("before.png"), bytes("undone.png"));
    EXPECT_NE(bytes("before.png"), bytes("layers.png"));
    EXPECT_EQ(bytes("scaled.png"), bytes("loaded.png"));
    EXPECT_TRUE(std::filesystem::exists(folder() / "window.png"));
}

TEST_F(ViewTest, AFullDiskIsASentence) {
    expectComplaint(runScript({{{"saveMaterial", "/dev/full"}}}, offscreen), 1,
                    {"script.json", "steps[0]", "/dev/full", "No space left"});
    expectComplaint(
        runScript({{{"panel", "Light"}}, {{"click", "light.remove"}}, {{"saveScene", "/dev/full"}}}, offscreen), 1,
        {"script.json", "steps[2]", "/dev/full"});
}

/// The largest difference of two pictures.
float difference(const std::filesystem::path& one, const std::filesystem::path& other) {
    const nacre::Image first = nacre::readImage(one);
    const nacre::Image second = nacre::readImage(other);
    EXPECT_EQ(first.values.size(), second.values.size());
    float most = 0;
    for (std::size_t i = 0; i < std::min(first.values.size(), second.values.size()); ++i) {
        most = std::max(most, std::abs(first.values[i] - second.values[i]));
    }
    return most;
}

/// Angles are in degrees in a scene file, which may change their last bit.
TEST_F(ViewTest, ASavedSceneIsThePictureAgain) {
    const Outcome outcome = runScript({{{"set", "material.scale"}, {"value", 6}},
                                       {{"panel", "Light"}},
                                       {{"set", "light.intensity"}, {"value", 9}},
                                       {{"drag", {0.5, 0.6}}, {"to", {0.62, 0.5}}},
                                       {{"saveMaterial", "structs.h"}},
                                       {{"saveScene", "scene.json"}},
                                       {{"wait", true}},
                                       {{"picture", "saved.exr"}},
                                       {{"open", "cube.obj"}},
                                       {{"wait", true}},
                                       {{"picture", "before.exr"}},
                                       {{"open", "scene.json"}},
                                       {{"wait", true}},
                                       {{"picture", "opened.exr"}}},
                                      offscreen);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_GT(difference(folder() / "saved.exr", folder() / "before.exr"), 0.1f);
    EXPECT_LT(difference(folder() / "saved.exr", folder() / "opened.exr"), 0.02f);
    EXPECT_NE(bytes("structs.h").find("static const NacreMaterial skin"), std::string::npos);
}

/// What somebody does who sees the window for the first time, by what is on the screen. docs/viewer.md has its
/// pictures.
TEST_F(ViewTest, ANewUserFindsTheWayFromAModelToASavedMaterial) {
    const Display display;
    if (!display.isThere()) {
        GTEST_SKIP() << "there is no Xvfb";
    }
    writeText(folder() / "model.obj", cubeObj);
    const std::filesystem::path script = std::filesystem::path(NACRE_SOURCE_DIR) / "docs/viewer-walk.json";
    const Outcome outcome = run({"view", "cube.obj", "--script", script.string(), "--validation"},
                                environmentOf({{"QT_QPA_PLATFORM", "xcb"}, {"DISPLAY", display.name()}}));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    const Json saved = Json::parse(bytes("my-skin.json"));
    EXPECT_EQ(saved.at("layers").size(), 7u); // those of skin, and one more
    for (const char* step : {"start", "open", "skin", "layer", "effect-off", "reference", "save"}) {
        EXPECT_TRUE(std::filesystem::exists(folder() / ("walk-" + std::string(step) + ".png"))) << step;
    }
}

TEST_F(ViewTest, AScriptUsesOnlyWhatIsOnTheScreen) {
    expectComplaint(runScript({{{"choose", "compare.second"}, {"item", "Effect off"}}}, offscreen), 1,
                    {"'compare.second'", "not on the screen"});
}

/// A program that is killed leaves what was edited to the next one, in another folder, too, and for every file name.
TEST_F(ViewTest, WhatACrashLeavesIsOfferedAgain) {
    const std::string model = "w\xfcrfel.obj";
    std::filesystem::rename(folder() / "cube.obj", folder() / model);
    const Json edits{{{"choose", "material.preset"}, {"item", "skin"}},
                     {{"set", "material.scale"}, {"value", 6}},
                     {{"panel", "Light"}},
                     {{"click", "light.remove"}},
                     {{"wait", true}},
                     {{"picture", "edited.png"}},
                     {{"pause", 60'000}}};
    writeText(folder() / "killed.json", Json{{"size", {500, 300}}, {"samples", 2}, {"steps", edits}}.dump());
    const nacre::test::RunningNacre running({"view", model, "--script", "killed.json"}, folder(),
                                            environmentOf(offscreen));
    const std::filesystem::path kept = folder() / "nacre/nacre";
    const auto isThere = [&] {
        return std::filesystem::exists(folder() / "edited.png") && std::filesystem::exists(kept) &&
               !std::filesystem::is_empty(kept);
    };
    for (int tries = 0; tries < 600 && !isThere(); ++tries) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ASSERT_TRUE(isThere());
    running.send(SIGKILL);
    EXPECT_EQ(running.wait().exitCode, 128 + SIGKILL);
    const std::filesystem::path elsewhere = folder() / "elsewhere";
    std::filesystem::create_directory(elsewhere);
    const Json steps{{{"recover", true}}, {{"wait", true}}, {{"picture", "recovered.png"}}};
    writeText(elsewhere / "script.json", Json{{"size", {500, 300}}, {"samples", 2}, {"steps", steps}}.dump());
    const Outcome outcome =
        nacre::test::runNacre({"view", "--script", "script.json"}, elsewhere, environmentOf(offscreen));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_EQ(bytes("elsewhere/recovered.png"), bytes("edited.png"));
    EXPECT_TRUE(std::filesystem::is_empty(kept)) << "it would be offered once more";
}

/// The whole reference takes minutes. Closing takes less than half a second on a machine that has nothing else to do,
/// but tests run beside each other.
TEST_F(ViewTest, ClosingWhileAReferenceRunsIsSoonOver) {
    const Json steps{{{"wait", true}},
                     {{"panel", "Compare"}},
                     {{"choose", "compare.second"}, {"item", "Reference (surface integral)"}},
                     {{"pause", 1500}},
                     {{"expect", "compare.progress"}, {"text", "samples a pixel"}},
                     {{"picture", "last.png"}}};
    writeText(folder() / "closed.json", Json{{"size", {500, 300}}, {"samples", 1}, {"steps", steps}}.dump());
    const nacre::test::RunningNacre running({"view", "cube.obj", "--material", "skin", "--script", "closed.json"},
                                            folder(), environmentOf(offscreen));
    while (!std::filesystem::exists(folder() / "last.png") && running.error().find("nacre: ") == std::string::npos) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const auto begin = std::chrono::steady_clock::now();
    const Outcome outcome = running.wait();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
}

TEST_F(ViewTest, AWrongStepIsNamed) {
    expectComplaint(runScript({{{"set", "material.sclae"}, {"value", 6}}}, offscreen), 1,
                    {"script.json: steps[0]", "'material.sclae'"});
}

/// Every size makes the window's images anew, under the validation layers.
TEST_F(ViewTest, AWindowIsResizedWithoutAComplaint) {
    const Display display;
    if (!display.isThere()) {
        GTEST_SKIP() << "there is no Xvfb";
    }
    Json steps = Json::array();
    std::uint32_t state = 1;
    const auto random = [&state](std::uint32_t low, std::uint32_t high) {
        state = state * 1664525u + 1013904223u;
        return low + (state >> 8) % (high - low);
    };
    constexpr int sizes = 200;
    for (int i = 0; i < sizes; ++i) {
        steps.push_back({{"size", {random(540, 700), random(200, 400)}}});
        if (i % 50 == 49) { // a minimised window is one that is not mapped
            steps.push_back({{"hide", true}});
            steps.push_back({{"pause", 20}});
            steps.push_back({{"hide", false}});
        }
    }
    steps.push_back({{"size", {560, 420}}});
    steps.push_back({{"drag", {0.3, 0.5}}, {"to", {0.6, 0.5}}});
    steps.push_back({{"wait", true}});
    steps.push_back({{"picture", "end.png"}});
    const Outcome outcome = runScript(steps, {{"QT_QPA_PLATFORM", "xcb"}, {"DISPLAY", display.name()}});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_TRUE(std::filesystem::exists(folder() / "end.png"));
}

#else

TEST_F(ViewTest, WithoutQtItSaysWhatIsMissing) {
    expectComplaint(run({"view", "cube.obj"}), 1, {"Qt 6", "qt6-base-dev", "--headless"});
}

#endif

} // namespace
