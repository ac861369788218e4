// `nacre compare`: what it says, what it writes, and what it refuses. Needs no device.
#include "running_nacre.hpp"
#include "schema.hpp"

#include "image/image_file.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <random>

namespace {

using nacre::Encoding;
using nacre::Image;
using nacre::test::CommandTest;
using nacre::test::expectComplaint;
using nacre::test::Outcome;
using nacre::test::readText;
using nacre::test::writeText;

class CompareTest : public CommandTest {
protected:
    /// Writes a ramp of light, every value times `factor`.
    Image store(const std::string& name, float factor = 1, std::uint32_t width = 24, std::uint32_t height = 16) const {
        Image image = nacre::makeImage(width, height, {"R", "G", "B"});
        for (std::size_t i = 0; i < image.values.size(); ++i) {
            image.values[i] = factor * (0.1f + 0.5f * static_cast<float>(i / 3 % width) / static_cast<float>(width));
        }
        nacre::writeImage(folder() / name, image);
        return image;
    }
    /// Compares, expects success, and returns the JSON.
    nlohmann::json compare(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "compare");
        arguments.insert(arguments.end(), {"--json", "result.json"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
        EXPECT_EQ(outcome.error, "");
        const std::string text = readText(folder() / "result.json");
        nacre::test::expectMatchesSchema(text, "comparison.schema.json");
        return nlohmann::json::parse(text);
    }
};

TEST_F(CompareTest, OfAPictureWithItselfFindsNothing) {
    for (const char* name : {"a.png", "a.exr", "a.hdr"}) {
        store(name);
        const nlohmann::json result = compare({name, name});
        EXPECT_EQ(result["flip"]["mean"], 0) << name;
        EXPECT_TRUE(result["psnr"].is_null()) << name;
        EXPECT_EQ(result["relMse"], 0) << name;
        EXPECT_EQ(result["energyRatio"], nlohmann::json::array({1, 1, 1})) << name;
        EXPECT_EQ(result["flip"]["kind"], std::string(name) == "a.png" ? "ldr" : "hdr");
    }
}

TEST_F(CompareTest, SaysInATableWhatDiffers) {
    store("a.exr", 1.1f);
    store("b.exr");
    const Outcome outcome = run({"compare", "a.exr", "b.exr"});
    EXPECT_EQ(outcome.exitCode, 0);
    for (const char* part : {"24 x 16 pixels, linear light", "384 of 384", "HDR-FLIP  mean 0.", "PSNR", "relMSE",
                             "SSIM", "energy    R 1.1000, G 1.1000, B 1.1000"}) {
        EXPECT_NE(outcome.output.find(part), std::string::npos) << part << " in\n" << outcome.output;
    }
    EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--json", "-"}).output.substr(0, 1), "{");
}

TEST_F(CompareTest, DrawsTheDifferenceAndTheHeat) {
    const Image reference = store("b.exr");
    Image test = reference;
    std::ranges::fill(test.at(3, 2), 1.0f);
    test.at(5, 6)[1] = 0;
    nacre::writeExr(folder() / "a.exr", test);
    const nlohmann::json result =
        compare({"a.exr", "b.exr", "--difference", "d.png", "--heat", "h.png", "--difference-range", "2"});
    EXPECT_EQ(result["files"].size(), 2u);
    const Image difference = nacre::readImage(folder() / "d.png");
    EXPECT_NEAR(difference.at(0, 0)[0], 0.5, 1 / 255.0);
    EXPECT_NEAR(difference.at(3, 2)[0], 0.5 + (1 - reference.at(3, 2)[0]) / 4, 1 / 255.0);
    EXPECT_LT(difference.at(5, 6)[1], 0.49);
    const Image heat = nacre::readImage(folder() / "h.png");
    EXPECT_EQ(heat.at(20, 14)[0], 0);
    EXPECT_GT(heat.at(3, 2)[0], 0.2);
}

TEST_F(CompareTest, CountsAMaskAMaterialOrBoth) {
    const Image reference = store("b.exr");
    Image test = nacre::makeImage(24, 16, {"R", "G", "B", "material.ID"});
    Image mask = nacre::makeImage(24, 16, {"Y"}, Encoding::Srgb);
    for (std::uint32_t y = 0; y < 16; ++y) {
        for (std::uint32_t x = 0; x < 24; ++x) {
            std::ranges::copy(reference.at(x, y), test.at(x, y).begin());
            test.at(x, y)[3] = x < 8 ? 1.0f : x < 12 ? 2.0f : 0.0f;
            mask.at(x, y)[0] = y < 4 ? 1.0f : 0.0f;
        }
    }
    test.at(20, 10)[0] += 5; // neither material nor mask has it
    nacre::writeExr(folder() / "a.exr", test);
    nacre::writePng(folder() / "mask.png", mask);
    writeText(folder() / "report.json", R"({"scene": {"materials": [{"name": "skin"}, {"name": "jade"}]}})");
    EXPECT_GT(compare({"a.exr", "b.exr"})["relMse"], 0.01);
    const auto pixelsOf = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"a.exr", "b.exr"});
        const nlohmann::json result = compare(arguments);
        EXPECT_EQ(result["relMse"], 0);
        return result["pixels"].get<int>();
    };
    EXPECT_EQ(pixelsOf({"--mask", "mask.png"}), 24 * 4);
    EXPECT_EQ(pixelsOf({"--mask", "a.exr:material.ID"}), 12 * 16);
    EXPECT_EQ(pixelsOf({"--material", "2"}), 4 * 16);
    EXPECT_EQ(pixelsOf({"--material", "1", "--material", "2"}), 12 * 16);
    EXPECT_EQ(pixelsOf({"--material", "skin", "--report", "report.json"}), 8 * 16);
    EXPECT_EQ(pixelsOf({"--material", "jade", "--report", "report.json", "--mask", "mask.png"}), 4 * 4);
    EXPECT_EQ(pixelsOf({"--material", "2", "--material-image", "a.exr"}), 4 * 16);
    expectComplaint(run({"compare", "a.exr", "b.exr", "--material", "wax", "--report", "report.json"}), 1,
                    {"report.json", "'wax'", "skin, jade"});
    expectComplaint(run({"compare", "a.exr", "b.exr", "--material", "skin"}), 1, {"'skin'", "--report"});
    expectComplaint(run({"compare", "a.exr", "b.exr", "--material", "9"}), 1, {"no pixel", "b.exr"});
    expectComplaint(run({"compare", "b.exr", "b.exr", "--material", "1"}), 1, {"channel ID", "--material-image"});
    expectComplaint(run({"compare", "a.exr", "b.exr", "--mask", "a.exr:depth"}), 1, {"a.exr", "depth", "material.ID"});
    expectComplaint(run({"compare", "a.exr", "b.exr", "--material", "skin", "--report", "a.exr"}), 1,
                    {"a.exr", "report"});
}

TEST_F(CompareTest, TellsChanceFromBias) {
    const Image light = store("b.exr", 1, 64, 64);
    Image reference = nacre::makeImage(64, 64, {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    Image test = light;
    std::mt19937 random(3);
    std::normal_distribution<float> normal(0, 0.02f);
    for (std::size_t pixel = 0; pixel < light.pixelCount(); ++pixel) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            reference.values[6 * pixel + channel] = light.values[3 * pixel + channel];
            reference.values[6 * pixel + 3 + channel] = 0.02f * 0.02f;
            test.values[3 * pixel + channel] += normal(random);
        }
    }
    nacre::writeExr(folder() / "r.exr", reference);
    nacre::writeExr(folder() / "a.exr", test);
    const nlohmann::json chance = compare({"a.exr", "r.exr"})["chance"];
    EXPECT_EQ(chance["values"], 3 * 64 * 64);
    EXPECT_NEAR(chance["chiSquaredPerDegreeOfFreedom"], 1, 0.06);
    EXPECT_LT(chance["beyond3StandardErrors"], 0.006);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--variance", "r.exr"})["chance"], chance);
    store("c.exr", 1.3f, 64, 64);
    EXPECT_GT(compare({"c.exr", "r.exr"})["chance"]["chiSquaredPerDegreeOfFreedom"], 4);
    EXPECT_TRUE(compare({"a.exr", "b.exr"})["chance"].is_null());
}

TEST_F(CompareTest, FailsAboveABoundAndSaysWhich) {
    store("a.exr", 1.1f);
    store("b.exr");
    compare({"a.exr", "b.exr", "--max-flip", "0.5", "--min-psnr", "10", "--max-relmse", "0.1", "--max-energy-error",
             "0.2"});
    compare({"b.exr", "b.exr", "--min-psnr", "100"});
    expectComplaint(run({"compare", "a.exr", "b.exr", "--max-energy-error", "0.05", "--json", "j.json"}), 1,
                    {"a.exr", "--max-energy-error 0.05", "0.1"});
    const nlohmann::json result = nlohmann::json::parse(readText(folder() / "j.json"));
    EXPECT_EQ(result["bounds"][0]["holds"], false);
    expectComplaint(run({"compare", "a.exr", "b.exr", "--max-flip", "0", "--min-psnr", "90", "--max-relmse", "0"}), 1,
                    {"--max-flip 0", "--min-psnr 90", "--max-relmse 0"});
}

TEST_F(CompareTest, NamesWhatCannotBeCompared) {
    store("a.exr");
    store("a.png");
    store("wide.exr", 1, 30);
    nacre::writeExr(folder() / "depth.exr", nacre::makeImage(24, 16, {"X", "Z"}));
    writeText(folder() / "text.png", "not a picture");
    expectComplaint(run({"compare", "wide.exr", "a.exr"}), 1, {"wide.exr", "30 x 16", "a.exr", "24 x 16"});
    expectComplaint(run({"compare", "a.exr", "depth.exr"}), 1, {"depth.exr", "no channel R"});
    expectComplaint(run({"compare", "a.png", "a.exr"}), 1, {"a.png", "a.exr", "--metric"});
    expectComplaint(run({"compare", "text.png", "a.png"}), 1, {"text.png", "PNG"});
    expectComplaint(run({"compare", "no.png", "a.png"}), 1, {"no.png", "No such file"});
    expectComplaint(run({"compare", "a.exr", "a.exr", "--mask", "wide.exr"}), 1, {"wide.exr", "30 x 16"});
    expectComplaint(run({"compare", "a.exr", "a.exr", "--variance", "depth.exr"}), 1, {"depth.exr", "no channel"});
    expectComplaint(run({"compare", "a.exr", "a.exr", "--heat", "no/h.png"}), 1, {"no/h.png"});
    EXPECT_EQ(compare({"a.png", "a.exr", "--metric", "ldr"})["flip"]["kind"], "ldr");
    EXPECT_EQ(compare({"a.png", "a.exr", "--metric", "hdr"})["test"]["encoding"], "linear");
}

} // namespace
