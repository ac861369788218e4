// `nacre compare --suite`: what it leaves behind, that it keeps references, and what it refuses. Needs a device.
#include "running_nacre.hpp"
#include "schema.hpp"

#include "image/image_file.hpp"

#include <nlohmann/json.hpp>

namespace {

using nacre::test::CommandTest;
using nacre::test::expectComplaint;
using nacre::test::Outcome;
using nacre::test::readText;

class SuiteTest : public CommandTest {
protected:
    /// One view in few pixels, few samples, two techniques.
    nlohmann::json runSuite(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"compare", "--suite", "--view",      "thin-ball-back",
                                           "--size",  "48x32",   "--technique", "off",
                                           "-o",      "out",     "--technique", "bank"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
        EXPECT_NE(outcome.output.find("thin-ball-back: "), std::string::npos) << outcome.output;
        const std::string text = readText(folder() / "out/accuracy.json");
        nacre::test::expectMatchesSchema(text, "accuracy.schema.json");
        return nlohmann::json::parse(text);
    }
};

const nlohmann::json& cellOf(const nlohmann::json& view, const std::string& technique, const std::string& reference) {
    for (const nlohmann::json& cell : view["cells"]) {
        if (cell["technique"] == technique && cell["reference"] == reference) {
            return cell;
        }
    }
    throw std::runtime_error("no cell of " + technique + " against " + reference);
}

TEST_F(SuiteTest, ComparesWritesItsReportsAndKeepsItsReferences) {
    const nlohmann::json first = runSuite({"--spp", "16"});
    ASSERT_EQ(first["views"].size(), 1u);
    const nlohmann::json& view = first["views"][0];
    EXPECT_EQ(view["references"].size(), 2u);
    EXPECT_EQ(view["cells"].size(), 4u);
    for (const nlohmann::json& reference : view["references"]) {
        EXPECT_EQ(reference["spp"], 16);
        EXPECT_GT(reference["noise"], 0);
    }
    for (const char* reference : {"surface", "walk"}) {
        const nlohmann::json& off = cellOf(view, "off", reference);
        const nlohmann::json& bank = cellOf(view, "bank", reference);
        EXPECT_GT(off["pixels"], 300) << "a ball fills most of 48 x 32 pixels' height";
        EXPECT_LT(off["energyRatio"][0], 0.5) << "nothing comes through from behind without the effect";
        EXPECT_GT(bank["energyRatio"][0], off["energyRatio"][0]);
        EXPECT_EQ(bank["thin"]["pixels"], bank["pixels"]) << "all of a ball of 3 mm is thin";
    }
    EXPECT_NE(readText(folder() / "out/accuracy.md").find("| thin-ball-back |"), std::string::npos);
    EXPECT_NE(readText(folder() / "out/accuracy.txt").find("thin-ball-back: "), std::string::npos);
    const std::string html = readText(folder() / "out/accuracy.html");
    for (const char* picture : {"surface", "walk", "off", "bank", "off-walk", "bank-surface"}) {
        const std::string file = "pictures/thin-ball-back-" + std::string(picture) + ".png";
        EXPECT_NE(html.find(file), std::string::npos) << file;
        EXPECT_EQ(nacre::readImage(folder() / "out" / file).width, 48u) << file;
    }

    const nlohmann::json second = runSuite({"--spp", "16"});
    EXPECT_EQ(second, first) << "the same references, and not a second more spent on them";
    const nlohmann::json finer = runSuite({"--spp", "20", "--reference", "surface"});
    ASSERT_EQ(finer["views"][0]["references"].size(), 1u);
    EXPECT_EQ(finer["views"][0]["references"][0]["spp"], 20);
    EXPECT_GT(finer["views"][0]["references"][0]["seconds"], view["references"][0]["seconds"]) << "it goes on from 16";
}

TEST_F(SuiteTest, SaysWhatThereIs) {
    const Outcome outcome = run({"compare", "--suite", "--list", "--view", "wedge*"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    for (const char* name : {"wedge-back-spot", "bank-surfaces", "walk"}) {
        EXPECT_NE(outcome.output.find(name), std::string::npos) << name;
    }
    EXPECT_EQ(outcome.output.find("gallery"), std::string::npos);
    EXPECT_TRUE(files().empty());
}

TEST_F(SuiteTest, RefusesWhatItCannotReadOrWrite) {
    nacre::test::writeText(folder() / "file", "");
    expectComplaint(run({"compare", "--suite", "--view", "plane", "-o", "file"}), 1, {"file"});
    expectComplaint(run({"compare", "--suite", "--view", "model-none-front", "--model", "none.glb", "-o", "out"}), 1,
                    {"none.glb"});
}

} // namespace
