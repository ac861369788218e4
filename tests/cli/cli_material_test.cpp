// `nacre material`: presets, round trips, and files with faults. Needs no device.
#include "running_nacre.hpp"
#include "schema.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace {

using nacre::test::CommandTest;
using nacre::test::expectComplaint;
using nacre::test::Outcome;
using nacre::test::readText;
using nacre::test::writeText;

class MaterialTest : public CommandTest {
protected:
    std::vector<std::string> presetNames() const {
        const Outcome outcome = run({"material", "list", "--json", "-"});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
        std::vector<std::string> names;
        const nlohmann::json list = nlohmann::json::parse(outcome.output);
        for (const nlohmann::json& material : list["materials"]) {
            names.push_back(material["name"]);
        }
        return names;
    }
};

TEST_F(MaterialTest, ListHasEveryPreset) {
    const std::vector<std::string> names = presetNames();
    const std::string text = run({"material", "list"}).output;
    for (const std::string& name : names) {
        EXPECT_NE(text.find(name), std::string::npos) << name;
    }
    for (const std::string name : {"skin", "marble", "wax", "jade", "leaf", "nacre"}) {
        EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    }
}

TEST_F(MaterialTest, EveryPresetShownAsJsonIsAValidMaterialFile) {
    for (const std::string& name : presetNames()) {
        const std::string file = name + ".json";
        EXPECT_EQ(run({"material", "show", name, "--json", file}).exitCode, 0);
        EXPECT_EQ(run({"material", "check", file}).exitCode, 0);
        nacre::test::expectMatchesSchema(readText(folder() / file), "material.schema.json");
        EXPECT_EQ(run({"material", "show", file, "--json", "-"}).output, readText(folder() / file));
    }
}

TEST_F(MaterialTest, ShowTellsRadiiAndTransmission) {
    writeText(folder() / "one.json", R"({"name": "one", "layers": [{"weight": [1, 1, 1], "variance": 2}]})");
    const Outcome outcome = run({"material", "show", "one.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    // rms radius of one Gaussian: sqrt(2 v) = 2 mm; through 2 mm: exp(-4 / 4) = 0.3679.
    EXPECT_NE(outcome.output.find("rms radius, mm                              2          2          2"),
              std::string::npos)
        << outcome.output;
    EXPECT_NE(outcome.output.find("through 2 mm                           0.3679     0.3679     0.3679"),
              std::string::npos)
        << outcome.output;
}

TEST_F(MaterialTest, ImportReadsMaterialX) {
    writeText(folder() / "wax.mtlx", R"(<materialx version="1.39"><open_pbr_surface name="wax">
        <input name="subsurface_weight" type="float" value="1" /><input name="subsurface_radius" value="0.2" />
        </open_pbr_surface></materialx>)");
    const Outcome imported = run({"material", "import", "wax.mtlx", "--json", "wax.json"});
    EXPECT_EQ(imported.exitCode, 0) << imported.error;
    EXPECT_EQ(imported.error, "nacre: note: wax.mtlx: open_pbr_surface \"wax\": subsurface_radius has no unit; taken "
                              "for centimetres\n");
    nacre::test::expectMatchesSchema(readText(folder() / "wax.json"), "material.schema.json");
    EXPECT_EQ(run({"material", "check", "wax.json"}).exitCode, 0);
    const Outcome shown = run({"material", "import", "wax.mtlx", "--units", "mm"});
    EXPECT_TRUE(shown.output.starts_with("wax: open_pbr_surface of wax.mtlx\n")) << shown.output;
    EXPECT_EQ(shown.error, "");
    nacre::test::expectComplaint(run({"material", "import", "wax.mtlx", "--name", "soap"}), 1, {"wax.mtlx", "soap"});
    std::filesystem::copy_file(folder() / "wax.mtlx", folder() / "w\xe4x.mtlx");
    nacre::test::expectComplaint(run({"material", "import", "w\xe4x.mtlx", "--json", "other.json"}), 1,
                                 {"w\\xe4x.mtlx: the name", "not UTF-8"});
    nacre::test::expectComplaint(run({"material", "import", "wax.mtlx", "--units", "ell"}), 2, {"--units", "ell"});
    nacre::test::expectComplaint(run({"material", "import", "wax.mtlx", "--json", "./wax.mtlx"}), 2, {"same file"});
    nacre::test::expectComplaint(run({"material", "import", "none.mtlx"}), 1, {"none.mtlx"});
}

constexpr const char* skinSlabs = R"([{"skin": {"melanin": 0.03}, "thickness": 0.1},
    {"skin": {"haemoglobin": 0.02, "water": 0.65}, "thickness": "infinite"}])";

TEST_F(MaterialTest, FitTellsLayersAndErrorAndWritesThem) {
    const Outcome outcome = run({"material", "fit", "--slabs", skinSlabs, "--json", "fit.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    for (const char* part : {"weight, variance", "largest CDF error", "diffuse reflectance", "diffuse transmittance"}) {
        EXPECT_NE(outcome.output.find(part), std::string::npos) << outcome.output;
    }
    const nlohmann::json layers = nlohmann::json::parse(readText(folder() / "fit.json"));
    EXPECT_TRUE(layers.contains("layers"));
    EXPECT_FALSE(layers.contains("slabs"));
    EXPECT_EQ(run({"material", "check", "fit.json"}).exitCode, 0);

    // A material file with slabs says the same, and is written as it was.
    writeText(folder() / "skin.json", std::string(R"({"name": "skin of slabs", "slabs": )") + skinSlabs + "}");
    EXPECT_EQ(run({"material", "fit", "skin.json", "--json", "-"}).exitCode, 0);
    EXPECT_EQ(run({"material", "show", "skin.json", "--json", "copy.json"}).exitCode, 0);
    const nlohmann::json copy = nlohmann::json::parse(readText(folder() / "copy.json"));
    EXPECT_EQ(copy["slabs"][0]["skin"]["melanin"], 0.03);
    EXPECT_FALSE(copy.contains("layers"));
    nacre::test::expectMatchesSchema(readText(folder() / "copy.json"), "material.schema.json");
    EXPECT_EQ(run({"material", "show", "copy.json", "--json", "-"}).output, readText(folder() / "copy.json"));
}

TEST_F(MaterialTest, FitOfLayersIsTheLayersAndFewerAreLessExact) {
    EXPECT_NE(run({"material", "fit", "skin"}).output.find("skin: 6 layers"), std::string::npos);
    const nlohmann::json four =
        nlohmann::json::parse(run({"material", "fit", "skin-burley", "--layers", "4", "--json", "-"}).output);
    EXPECT_LE(four["layers"].size(), 4U);
    EXPECT_FALSE(four.contains("meanFreePath"));
}

TEST_F(MaterialTest, FitRefusesWhatItCannotFit) {
    expectComplaint(run({"material", "fit"}), 2, {"MATERIAL", "--slabs"});
    expectComplaint(run({"material", "fit", "skin", "--slabs", "[]"}), 2, {"MATERIAL", "--slabs"});
    expectComplaint(run({"material", "fit", "skin", "--layers", "33"}), 2, {"--layers", "33"});
    expectComplaint(run({"material", "fit", "--slabs", "[]"}), 1, {"--slabs", "0 entries"});
    expectComplaint(run({"material", "fit", "--slabs", R"([{"thickness": 1}])", "--json", "fit.json"}), 1,
                    {"--slabs", "slabs[0].absorption"});
    EXPECT_TRUE(files().empty());
}

TEST_F(MaterialTest, ShowDrawsPicturesOfMaterials) {
    EXPECT_EQ(run({"material", "show", "skin", "--plot", "skin.svg"}).exitCode, 0);
    const std::string svg = readText(folder() / "skin.svg");
    EXPECT_TRUE(svg.starts_with("<?xml")) << svg.substr(0, 40);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    EXPECT_EQ(run({"material", "show", "skin-burley", "--plot", "burley.png"}).exitCode, 0);
    EXPECT_TRUE(readText(folder() / "burley.png").starts_with("\x89PNG"));
    expectComplaint(run({"material", "show", "skin", "--plot", "skin.pdf"}), 2, {"skin.pdf", ".png", ".svg"});
    expectComplaint(run({"material", "show", "skin", "--plot", "missing/skin.png"}), 1, {"missing/skin.png"});
    EXPECT_EQ(files().size(), 2U);
}

struct Fault {
    std::string name;
    std::string text;
    std::vector<std::string> parts;
};

std::string layersText(int count) {
    std::string text = R"({"name": "m", "layers": [)";
    for (int index = 0; index < count; ++index) {
        text += std::string(index == 0 ? "" : ", ") + R"({"weight": [1, 1, 1], "variance": 1})";
    }
    return text + "]}";
}

const std::vector<Fault> faults{
    {"NotJson", "skin", {}},
    {"Empty", "", {}},
    {"CutOff", R"({"name": "m", "layers": [{"weight": [1, 1)", {}},
    {"UnknownKey", R"({"name": "m", "colour": 1, "layers": [{"weight": [1, 1, 1], "variance": 1}]})", {"colour"}},
    {"UnknownLayerKey", R"({"layers": [{"weight": [1, 1, 1], "varience": 1}]})", {"varience"}},
    {"Nan", R"({"layers": [{"weight": [1, 1, 1], "variance": NaN}]})", {}},
    {"NanWord", R"({"layers": [{"weight": [1, 1, 1], "variance": "NaN"}]})", {"variance", "NaN"}},
    {"Infinite", R"({"layers": [{"weight": [1, 1, 1], "variance": 1e999}]})", {}},
    {"NegativeVariance", R"({"layers": [{"weight": [1, 1, 1], "variance": -0.5}]})", {"variance", "-0.5"}},
    {"NegativeWeight", R"({"layers": [{"weight": [1, -1, 1], "variance": 1}]})", {"weight", "-1"}},
    {"TooManyLayers", layersText(33), {"layers", "33"}},
    {"NoLayers", R"({"name": "m", "layers": []})", {"layers"}},
    {"NoProfile", R"({"name": "m"})", {"layers"}},
    {"ZeroWeights", R"({"layers": [{"weight": [0, 1, 1], "variance": 1}]})", {"weight"}},
    {"Translucency",
     R"({"translucency": 1.5, "layers": [{"weight": [1, 1, 1], "variance": 1}]})",
     {"translucency", "1.5"}},
    {"Scale", R"({"scale": 0, "layers": [{"weight": [1, 1, 1], "variance": 1}]})", {"scale", "0"}},
};

class FaultTest : public CommandTest, public testing::WithParamInterface<Fault> {};

TEST_P(FaultTest, IsOneSentenceThatNamesFileAndField) {
    writeText(folder() / "faulty.json", GetParam().text);
    std::vector<std::string> parts = GetParam().parts;
    parts.emplace_back("faulty.json");
    expectComplaint(run({"material", "check", "faulty.json"}), 1, parts);
    expectComplaint(run({"material", "show", "faulty.json", "--json", "copy.json"}), 1, parts);
    EXPECT_EQ(files(), std::vector<std::string>{"faulty.json"});
}

INSTANTIATE_TEST_SUITE_P(Material, FaultTest, testing::ValuesIn(faults),
                         [](const auto& test) { return test.param.name; });

TEST_F(MaterialTest, MissingFileIsNamed) {
    expectComplaint(run({"material", "check", "none.json"}), 1, {"none.json"});
    expectComplaint(run({"material", "check", "."}), 1, {"."});
}

TEST_F(MaterialTest, UnwritableOutputsAreNamedAndNothingIsLeft) {
    expectComplaint(run({"material", "show", "skin", "--json", "missing/skin.json"}), 1,
                    {"missing/skin.json", "missing"});
    expectComplaint(run({"material", "show", "skin", "--json", "."}), 1, {"."});
    expectComplaint(run({"material", "list", "--json", "/dev/full"}), 1, {"/dev/full", "No space left"});
    EXPECT_TRUE(files().empty());
}

} // namespace
