// `nacre view`: frames without a window, turntables, and scripts that drive the window.
#include "running_nacre.hpp"

#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>
#include <string>
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
        Environment environment = platform;
        for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_RUNTIME_DIR"}) {
            environment.emplace_back(name, folder().string());
        }
        return run({"view", "cube.obj", "--material", "skin", "--script", "script.json", "--validation"}, environment);
    }

    std::string bytes(const std::string& file) const { return readText(folder() / file); }
};

/// Qt without a display: frames are drawn and not shown.
const Environment offscreen{{"QT_QPA_PLATFORM", "offscreen"}};

TEST_F(ViewTest, HeadlessSaysWhatFramesTakeWithLightsStillAndMoving) {
    const Outcome outcome =
        run({"view", "cube.obj", "--headless", "--frames", "3", "--size", "32x18", "--shadow-map-size", "64"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    for (const char* part : {"32x18, 3 frames", "lights still", "lights moving", "scatter and transmit, device",
                             "frame, processor", "p99", "G-buffer"}) {
        EXPECT_NE(outcome.output.find(part), std::string::npos) << part << "\n" << outcome.output;
    }
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
                                       {{"choose", "compare.second"}, {"item", "Effect off"}},
                                       {{"choose", "compare.mode"}, {"item", "A and B, divided"}},
                                       {{"wait", true}},
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
    constexpr int sizes = 30;
    for (int i = 0; i < sizes; ++i) {
        steps.push_back({{"size", {random(540, 900), random(200, 700)}}});
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
