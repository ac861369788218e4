// `nacre reference` as a user runs it: pictures, reports, parts, resuming and what it refuses. Needs no device.
#include "image/image_file.hpp"
#include "running_nacre.hpp"
#include "schema.hpp"

#include <nlohmann/json.hpp>

#include <csignal>
#include <thread>

namespace {

using nacre::test::CommandTest;
using nacre::test::cubeObj;
using nacre::test::expectComplaint;
using nacre::test::expectMatchesSchema;
using nacre::test::Outcome;
using nacre::test::readText;
using nacre::test::RunningNacre;
using nacre::test::writeText;

class ReferenceCommandTest : public CommandTest {
protected:
    void SetUp() override { writeText(folder() / "cube.obj", cubeObj); }
    std::vector<std::string> arguments(const std::vector<std::string>& more) const {
        std::vector<std::string> all{"reference", "cube.obj", "--material", "skin-burley", "--size", "24x16"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    nlohmann::json report(const std::string& file) const {
        const std::string text = readText(folder() / file);
        expectMatchesSchema(text, "reference.schema.json");
        return nlohmann::json::parse(text);
    }
};

TEST_F(ReferenceCommandTest, WritesPictureCheckpointAndReport) {
    const Outcome outcome = run(arguments({"--spp", "4", "-o", "r.exr", "--json", "r.json"}));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_NE(outcome.output.find("r.exr"), std::string::npos);
    EXPECT_EQ(files(), (std::vector<std::string>{"cube.obj", "r.exr", "r.exr.checkpoint", "r.json"}));
    const nlohmann::json json = report("r.json");
    EXPECT_EQ(json["spp"]["least"], 4);
    EXPECT_EQ(json["stoppedBy"], "spp");
    EXPECT_GT(json["noise"].get<double>(), 0);
    EXPECT_EQ(json.at("scene").at("name"), "cube.obj");
    EXPECT_TRUE(json["scene"].at("notes").empty());
    const nacre::Image image = nacre::readRadiance(folder() / "r.exr");
    EXPECT_EQ(image.width, 24u);
    EXPECT_EQ(image.values[3], 0); // nothing in the corner
    const std::size_t middle = (8 * 24 + 12) * 4;
    EXPECT_GT(image.values[middle], 0);
    EXPECT_EQ(image.values[middle + 3], 1);
}

TEST_F(ReferenceCommandTest, NotesStandInTheReport) {
    writeText(folder() / "large.obj", nacre::test::largeObj);
    const Outcome outcome =
        run({"reference", "large.obj", "--size", "4x4", "--spp", "1", "-o", "r.exr", "--json", "r.json"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.error;
    const nlohmann::json notes = report("r.json").at("scene").at("notes");
    ASSERT_EQ(notes.size(), 1u);
    const auto note = notes[0].get<std::string>();
    EXPECT_NE(note.find("large.obj: does not state its unit"), std::string::npos) << note;
    EXPECT_NE(outcome.error.find("nacre: note: " + note + '\n'), std::string::npos) << outcome.error;
}

TEST_F(ReferenceCommandTest, PartsMergeToTheWholeToTheLastBit) {
    EXPECT_EQ(run(arguments({"--spp", "3", "-o", "whole.exr"})).exitCode, 0);
    EXPECT_EQ(run(arguments({"--spp", "3", "-o", "a.exr", "--part", "1/2"})).exitCode, 0);
    EXPECT_EQ(run(arguments({"--spp", "3", "-o", "b.exr", "--part", "2/2", "--threads", "1"})).exitCode, 0);
    EXPECT_EQ(run({"reference", "merge", "m.exr", "a.exr", "b.exr", "--json", "m.json"}).exitCode, 0);
    EXPECT_TRUE(readText(folder() / "m.exr") == readText(folder() / "whole.exr"));
    EXPECT_EQ(report("m.json")["stoppedBy"], "merge");
    EXPECT_TRUE(report("m.json").at("scene").at("notes").empty());
    // What was merged goes on like the whole.
    EXPECT_EQ(run(arguments({"--spp", "5", "-o", "whole.exr", "--resume"})).exitCode, 0);
    EXPECT_EQ(run(arguments({"--spp", "5", "-o", "m.exr", "--resume"})).exitCode, 0);
    EXPECT_TRUE(readText(folder() / "m.exr") == readText(folder() / "whole.exr"));
    expectComplaint(run({"reference", "merge", "n.exr", "a.exr"}), 1, {"part 2/2"});
    expectComplaint(run({"reference", "merge", "n.exr", "a.exr", "whole.exr"}), 1, {"whole.exr", "1/1"});
    expectComplaint(run({"reference", "merge", "n.exr", "cube.obj"}), 1, {"cube.obj", "not a checkpoint"});
}

TEST_F(ReferenceCommandTest, InterruptedItKeepsWhatItHas) {
    const RunningNacre running(arguments({"--spp", "100000000", "-o", "r.exr"}), folder());
    for (int i = 0; i < 600 && !std::filesystem::exists(folder() / "r.exr.checkpoint"); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    running.send(SIGINT);
    const Outcome outcome = running.wait();
    EXPECT_EQ(outcome.exitCode, 128 + SIGINT);
    EXPECT_NE(outcome.error.find("--resume"), std::string::npos) << outcome.error;
    EXPECT_EQ(run(arguments({"--spp", "1", "-o", "r.exr", "--resume"})).exitCode, 0);
    // Neither lost by mistake nor continued as something else.
    expectComplaint(run(arguments({"--spp", "1", "-o", "r.exr"})), 1, {"r.exr.checkpoint", "--resume", "--restart"});
    expectComplaint(run(arguments({"--spp", "1", "-o", "r.exr", "--resume", "--seed", "2"})), 1,
                    {"r.exr.checkpoint", "seed", "'1'", "'2'"});
    EXPECT_EQ(run(arguments({"--spp", "1", "-o", "r.exr", "--restart", "--seed", "2"})).exitCode, 0);
}

TEST_F(ReferenceCommandTest, TakesDirectLightFromAnImage) {
    // Twice as bright wherever the camera looks, whatever the lights.
    const std::vector<std::string> names{"R", "G", "B"};
    for (const int brightness : {1, 2}) {
        const std::vector<float> pixels(24 * 16 * 3, static_cast<float>(brightness));
        nacre::writeExr(folder() / (std::to_string(brightness) + ".exr"), {24, 16, names, pixels});
        EXPECT_EQ(run(arguments({"--spp", "16", "-o", "r" + std::to_string(brightness) + ".exr", "--direct",
                                 std::to_string(brightness) + ".exr"}))
                      .exitCode,
                  0);
    }
    const std::size_t middle = (8 * 24 + 12) * 4;
    const auto one = nacre::readRadiance(folder() / "r1.exr").values;
    const auto two = nacre::readRadiance(folder() / "r2.exr").values;
    EXPECT_GT(one[middle], 0);
    EXPECT_NEAR(two[middle] / one[middle], 2, 0.05);
    expectComplaint(run({"reference", "cube.obj", "--size", "24x24", "--direct", "1.exr"}), 1,
                    {"1.exr", "24x16", "24x24"});
}

struct ReferenceFault {
    std::string name;
    std::vector<std::string> arguments;
    std::vector<std::string> parts;
};

class ReferenceUsageTest : public CommandTest, public testing::WithParamInterface<ReferenceFault> {};

TEST_P(ReferenceUsageTest, IsOneSentenceAndLeavesNothing) {
    std::vector<std::string> all{"reference"};
    all.insert(all.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    expectComplaint(run(all), 2, GetParam().parts);
    EXPECT_TRUE(files().empty());
}

INSTANTIATE_TEST_SUITE_P(
    Usage, ReferenceUsageTest,
    testing::Values(ReferenceFault{"Method", {"--method", "magic"}, {"method", "'magic'", "surface"}},
                    ReferenceFault{"Png", {"-o", "r.png"}, {"--output", "r.png", ".exr"}},
                    ReferenceFault{"PartText", {"--part", "2"}, {"--part", "'2'", "I/N"}},
                    ReferenceFault{"PartRange", {"--part", "3/2"}, {"--part 3/2"}},
                    ReferenceFault{"PartZero", {"--part", "0/2"}, {"--part 0/2"}},
                    ReferenceFault{"SppZero", {"--spp", "0"}, {"--spp 0"}},
                    ReferenceFault{"Noise", {"--noise", "0"}, {"--noise 0"}},
                    ReferenceFault{"NoiseNan", {"--noise", "nan"}, {"--noise"}},
                    ReferenceFault{"Time", {"--time", "-1"}, {"--time"}},
                    ReferenceFault{"Size", {"--size", "0x9"}, {"--size", "0x9"}},
                    ReferenceFault{"ResumeAndRestart", {"--resume", "--restart"}, {"--resume", "--restart"}},
                    ReferenceFault{"Boundary", {"--boundary", "fresnel"}, {"--boundary requires --method walk"}},
                    ReferenceFault{"Anisotropy", {"--anisotropy", "0.5"}, {"--anisotropy requires --method walk"}},
                    ReferenceFault{"NoExchange",
                                   {"--method", "walk", "--no-exchange"},
                                   {"--no-exchange requires --method surface"}},
                    ReferenceFault{"SameFile", {"-o", "a.exr", "--direct", "a.exr"}, {"same file", "a.exr"}},
                    ReferenceFault{"MergeNothing", {"merge", "m.exr"}, {"PARTS"}},
                    ReferenceFault{"MergePng", {"merge", "m.png", "a.exr"}, {"m.png", ".exr"}}),
    [](const auto& test) { return test.param.name; });

TEST_F(ReferenceCommandTest, BadInputLeavesNothing) {
    writeText(folder() / "noise.exr", "hello");
    const std::vector<std::string> before = files();
    expectComplaint(run({"reference", "none.glb"}), 1, {"none.glb", "No such file"});
    expectComplaint(run(arguments({"-o", "missing/r.exr"})), 1, {"missing/r.exr", "no folder"});
    expectComplaint(run(arguments({"--direct", "noise.exr"})), 1, {"noise.exr"});
    expectComplaint(run(arguments({"--camera", "9"})), 1, {"camera '9'"});
    EXPECT_EQ(files(), before);
}

TEST_F(ReferenceCommandTest, HelpShowsHowToShareTheWork) {
    const Outcome outcome = run({"reference", "--help"});
    EXPECT_EQ(outcome.exitCode, 0);
    for (const char* part : {"Examples:", "--part", "--resume", "merge", "variance"}) {
        EXPECT_NE(outcome.output.find(part), std::string::npos) << part;
    }
}

} // namespace
