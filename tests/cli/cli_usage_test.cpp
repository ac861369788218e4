// Help, version, and wrong usage: exit code 2 and one sentence that names the option and its value. Needs no device.
#include "running_nacre.hpp"

#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace {

using nacre::test::CommandTest;
using nacre::test::expectComplaint;
using nacre::test::Outcome;
using nacre::test::readText;
using nacre::test::writeText;

struct WrongUsage {
    std::string name;
    std::vector<std::string> arguments;
    std::vector<std::string> parts;
};

const std::vector<WrongUsage> wrongUsages{
    {"UnknownCommand", {"paint"}, {"paint"}},
    {"UnknownOption", {"render", "--colour", "red"}, {"--colour"}},
    {"TwoScenes", {"render", "a.obj", "b.obj"}, {"b.obj"}},
    {"LightThenTwoScenes", {"render", "--light", "back", "a.obj", "b.obj"}, {"b.obj"}},
    {"AovThenTwoScenes", {"render", "--aov", "depth=d.exr", "a.obj", "b.obj"}, {"b.obj"}},
    {"MissingValue", {"render", "--size"}, {"--size"}},
    {"SizeZero", {"render", "--size", "0x0"}, {"--size", "0x0", "1x1"}},
    {"SizeHuge", {"render", "--size", "100000x100000"}, {"--size", "100000x100000", "16384x16384"}},
    {"SizeOverflow", {"render", "--size", "99999999999999999999x1"}, {"--size", "99999999999999999999x1"}},
    {"SizeHalf", {"render", "--size", "12x"}, {"--size", "'12x'", "WIDTHxHEIGHT"}},
    {"SizeNegative", {"render", "--size=-1x5"}, {"--size", "'-1x5'"}},
    {"SizeTail", {"render", "--size", "12x34px"}, {"--size", "'12x34px'"}},
    {"SizeEmpty", {"render", "--size", ""}, {"--size"}},
    {"Technique", {"render", "--technique", "magic"}, {"technique", "'magic'", "separable", "brute"}},
    {"Material", {"render", "--material", "custard"}, {"material", "'custard'", "nacre material list"}},
    {"MaterialShow", {"material", "show", "custard"}, {"'custard'"}},
    {"MaterialAlone", {"material"}, {"subcommand"}},
    {"MaterialCheckNothing", {"material", "check"}, {"FILE"}},
    {"AovName", {"render", "--aov", "beauty=b.exr"}, {"AOV", "'beauty'", "irradiance"}},
    {"AovFile", {"render", "--aov", "depth=d.png"}, {"depth", "'d.png'", ".exr"}},
    {"AovNoFile", {"render", "--aov", "depth"}, {"--aov", "'depth'", "NAME=FILE.exr"}},
    {"OutputKind", {"render", "-o", "picture.jpg"}, {"--output", "'picture.jpg'", ".png"}},
    {"OutputEmpty", {"render", "-o", ""}, {"--output"}},
    {"SceneEmpty", {"render", ""}, {"SCENE", "empty"}},
    {"LightEmpty", {"render", "--light", ""}, {"--light", "empty"}},
    {"MaterialEmpty", {"render", "--material", ""}, {"--material", "empty"}},
    {"CameraEmpty", {"render", "--camera="}, {"--camera", "missing"}},
    {"CameraPositionEmpty", {"render", "--camera-position", ""}, {"--camera-position", "empty"}},
    {"JsonEmpty", {"devices", "--json", ""}, {"--json", "empty"}},
    {"CompareOne", {"compare", "a.png"}, {"REFERENCE"}},
    {"CompareNothing", {"compare"}, {"TEST", "REFERENCE", "--suite"}},
    {"CompareListAlone", {"compare", "--list"}, {"--list", "--suite"}},
    {"SuiteAndPictures", {"compare", "--suite", "a.png", "b.png"}, {"--suite"}},
    {"SuiteAndMask", {"compare", "--suite", "--mask", "m.png"}, {"--mask", "--suite"}},
    {"SuiteView", {"compare", "--suite", "--view", "attic"}, {"--view", "'attic'", "gallery-front"}},
    {"SuiteTechnique", {"compare", "--suite", "--technique", "magic"}, {"--technique", "'magic'", "bank"}},
    {"SuiteReference", {"compare", "--suite", "--reference", "guess"}, {"--reference", "'guess'", "surface, walk"}},
    {"SuiteSize", {"compare", "--suite", "--size", "8x8"}, {"--size", "'8x8'", "16x16"}},
    {"SuiteSpp", {"compare", "--suite", "--spp", "1"}, {"--spp 1", "2 to"}},
    {"SuiteNoise", {"compare", "--suite", "--noise", "0"}, {"--noise 0"}},
    {"SuiteTime", {"compare", "--suite", "--time", "0"}, {"--time 0"}},
    {"CompareMetric", {"compare", "a.png", "b.png", "--metric", "ssim"}, {"'ssim'", "ldr", "hdr"}},
    {"CompareFlipBound", {"compare", "a.png", "b.png", "--max-flip", "2"}, {"--max-flip 2", "0 to 1"}},
    {"CompareFlipNan", {"compare", "a.png", "b.png", "--max-flip", "nan"}, {"--max-flip nan", "0 to 1"}},
    {"ComparePpd", {"compare", "a.png", "b.png", "--ppd", "0"}, {"--ppd 0", "1 to 1000"}},
    {"ComparePeak", {"compare", "a.png", "b.png", "--peak", "-1"}, {"--peak -1"}},
    {"CompareHeatKind", {"compare", "a.png", "b.png", "--heat", "h.jpg"}, {"--heat", "'h.jpg'", ".png"}},
    {"CompareOverItsInput", {"compare", "a.png", "b.png", "--heat", "./b.png"}, {"same file", "b.png"}},
    {"CompareTwice", {"compare", "a", "b", "--heat", "h.png", "--difference", "h.png"}, {"same file", "h.png"}},
    {"CompareReportAlone", {"compare", "a.png", "b.png", "--report", "r.json"}, {"--report", "--material"}},
    {"BenchSecondsNan", {"bench", "pareto", "--seconds", "nan"}, {"--seconds nan", "1 to 86400"}},
    {"BenchSecondsZero", {"bench", "pareto", "--seconds", "0"}, {"--seconds 0", "1 to 86400"}},
    {"BenchSceneEmpty", {"bench", "pareto", "--scene", ""}, {"--scene", "empty"}},
    {"SameFile", {"render", "-o", "a.exr", "--aov", "depth=a.exr"}, {"same file", "a.exr"}},
    {"SameFileDifferentlySpelt", {"render", "-o", "a.exr", "--aov", "depth=./a.exr"}, {"same file", "a.exr"}},
    {"OutputIsInput", {"render", "s.json", "--json", "s.json"}, {"same file", "s.json"}},
    {"Samples", {"render", "--samples", "9"}, {"--samples 9"}},
    {"ShadowMapZero", {"render", "--shadow-map-size", "0"}, {"--shadow-map-size 0"}},
    {"ShadowMapHuge", {"render", "--shadow-map-size", "99999"}, {"--shadow-map-size 99999"}},
    {"ShadowMapWord", {"render", "--shadow-map-size", "big"}, {"--shadow-map-size", "big"}},
    {"ExposureNan", {"render", "--exposure", "nan"}, {"--exposure", "nan"}},
    {"ExposureHuge", {"render", "--exposure", "1e9"}, {"--exposure", "1e+09"}},
    {"ExposureOfAnExr", {"render", "--exposure", "1", "-o", "a.exr"}, {"--exposure", "'a.exr'"}},
    {"CameraPositionFar", {"render", "--camera-position", "0,2e9,0"}, {"--camera-position 2e+09", "1e+09"}},
    {"CameraTargetFar", {"render", "--camera-target=0,0,-1e30"}, {"--camera-target -1e+30", "-1e+09"}},
    {"CameraPositionShort", {"render", "--camera-position", "1,2"}, {"--camera-position", "'1,2'"}},
    {"CameraPositionLong", {"render", "--camera-position", "1,2,3,4"}, {"--camera-position", "'1,2,3,4'"}},
    {"CameraPositionInfinite", {"render", "--camera-position", "1,inf,0"}, {"--camera-position", "1,inf,0"}},
    {"FieldOfView", {"render", "--fov", "180"}, {"--fov 180"}},
    {"BakeAlone", {"bake"}, {"subcommand"}},
    {"BakeKind", {"bake", "thickness", "-o", "t.jpg"}, {"--output", "'t.jpg'", ".exr", ".png", ".ply"}},
    {"BakeSize", {"bake", "thickness", "--size", "64"}, {"--size", "'64'"}},
    {"BakeRaysZero", {"bake", "thickness", "--rays", "0"}, {"--rays 0", "1 to 65536"}},
    {"BakeWhite", {"bake", "thickness", "-o", "t.png", "--white", "0"}, {"--white 0"}},
    {"BakeWhiteOfAnExr", {"bake", "thickness", "-o", "t.exr", "--white", "9"}, {"--white", "'t.exr'"}},
    {"BakeSizeOfAPly", {"bake", "thickness", "-o", "t.ply", "--size", "9x9"}, {"--size requires a picture", "'t.ply'"}},
    {"BakeNeutralSkin", {"bake", "thickness", "--neutral", "--material", "skin"}, {"--neutral", "--material"}},
    {"BakeResumeRestart", {"bake", "thickness", "--resume", "--restart"}, {"--resume", "--restart"}},
    {"BakeOverItsInput", {"bake", "thickness", "a.ply", "-o", "./a.ply"}, {"same file", "a.ply"}},
};

class WrongUsageTest : public CommandTest, public testing::WithParamInterface<WrongUsage> {};

TEST_P(WrongUsageTest, IsOneSentenceAndLeavesNothing) {
    expectComplaint(run(GetParam().arguments), 2, GetParam().parts);
    EXPECT_TRUE(files().empty());
}

INSTANTIATE_TEST_SUITE_P(Usage, WrongUsageTest, testing::ValuesIn(wrongUsages),
                         [](const auto& test) { return test.param.name; });

class UsageTest : public CommandTest {
protected:
    void expectText(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0);
        EXPECT_EQ(outcome.error, "");
        for (const std::string& part : parts) {
            EXPECT_NE(outcome.output.find(part), std::string::npos) << "'" << part << "' is not in:\n"
                                                                    << outcome.output;
        }
    }
};

TEST_F(UsageTest, NoOutputReplacesAnotherFileThroughALink) {
    writeText(folder() / "scene.json", "{}");
    std::filesystem::create_symlink("scene.json", folder() / "link.json");
    std::filesystem::create_hard_link(folder() / "scene.json", folder() / "twin.json");
    std::filesystem::create_directory_symlink(".", folder() / "here");
    const std::vector<std::string> before = files();
    for (const char* output : {"link.json", "twin.json", "here/scene.json"}) {
        expectComplaint(run({"render", "scene.json", "--json", output}), 2, {"same file", "'scene.json'", output});
    }
    expectComplaint(run({"render", "-o", "a.exr", "--aov", "depth=here/a.exr"}), 2, {"same file", "here/a.exr"});
    EXPECT_EQ(files(), before);
    EXPECT_EQ(readText(folder() / "scene.json"), "{}");
}

TEST_F(UsageTest, AloneSaysWhatThereIs) {
    expectText({}, {"render", "material", "devices", "Examples", "--help"});
}

TEST_F(UsageTest, VersionIsTheProjects) {
    expectText({"--version"}, {"nacre " NACRE_VERSION});
}

TEST_F(UsageTest, HelpOfRenderHasEveryOptionAndExamples) {
    expectText(
        {"render", "--help"},
        {"--output",   "--size",  "--technique", "--no-scatter",      "--no-transmit",   "--material", "--front",
         "--back",     "--light", "--camera",    "--camera-position", "--camera-target", "--fov",      "--exposure",
         "--aov",      "--json",  "--device",    "--shadow-map-size", "--validation",    "1280x720",   "Examples",
         "irradiance", "brute"});
}

TEST_F(UsageTest, HelpOfTheOtherCommands) {
    expectText({"devices", "--help"}, {"--json"});
    expectText({"bake", "thickness", "--help"},
               {"--output", "--size", "--white", "--surface", "--material", "--neutral", "--rays", "--seed",
                "--threads", "--resume", "--restart", "--json", "KHR_materials_volume", "Examples"});
    expectText({"material", "--help"}, {"list", "show", "check", "fit"});
    expectText({"material", "show", "--help"}, {"MATERIAL", "--json", "--plot", ".svg"});
    expectText({"material", "fit", "--help"}, {"MATERIAL", "--slabs", "--layers", "--json", "skin"});
}

TEST_F(UsageTest, HelpOfEveryCommandHasExamplesOfIt) {
    for (const std::string& command :
         std::vector<std::string>{"render", "view", "devices", "material", "material list", "material show",
                                  "material check", "material fit", "bench", "bench thesis", "bench sweep",
                                  "bench pareto", "bench diff", "bench report", "bench markdown"}) {
        std::istringstream words(command);
        std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
        arguments.emplace_back("--help");
        expectText(arguments, {"Examples:\n", "  nacre " + command});
    }
}

} // namespace
