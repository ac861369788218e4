#include "nacre/files.hpp"
#include "nacre/layering.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace nacre;

namespace {

std::string faultOf(const std::string& json) {
    try {
        parseMaterial(json, "test.json");
    } catch (const FileError& error) {
        return error.what();
    }
    return "accepted";
}

std::string withLayers(const std::string& layers, const std::string& more = "") {
    return R"({"layers": )" + layers + more + "}";
}

const std::string oneLayer = R"([{"weight": [1, 1, 1], "variance": 1}])";

TEST(MaterialFile, ReadsEveryMember) {
    const Material material = parseMaterial(R"({
        "$schema": "material.schema.json", "name": "jelly", "description": "wobbles",
        "layers": [{"weight": [1, 0.5, 0.25], "variance": 0.5}, {"variance": 2, "weight": [0, 0.5, 0.75]}],
        "albedoUse": "preAndPost", "strength": 0.75, "translucency": 0.25, "scale": 2,
        "secondSurfaces": true, "albedo": [0.1, 0.2, 0.3], "roughness": 0.125, "specular": 0.875})",
                                            "test.json");
    EXPECT_EQ(material.name, "jelly");
    EXPECT_EQ(material.description, "wobbles");
    const std::vector<Layer> layers{{{1, 0.5, 0.25}, 0.5}, {{0, 0.5, 0.75}, 2}};
    EXPECT_EQ(material.layers, layers);
    EXPECT_FALSE(material.meanFreePath);
    EXPECT_EQ(material.albedoUse, AlbedoUse::PreAndPost);
    EXPECT_EQ(material.strength, 0.75);
    EXPECT_EQ(material.translucency, 0.25);
    EXPECT_EQ(material.scale, 2);
    EXPECT_EQ(material.secondSurfaces, true);
    EXPECT_EQ(material.albedo, (Rgb{0.1, 0.2, 0.3}));
    EXPECT_EQ(material.roughness, 0.125);
    EXPECT_EQ(material.specular, 0.875);
}

TEST(MaterialFile, ReadsAMeanFreePathAndKeepsDefaults) {
    const Material material = parseMaterial(R"({"meanFreePath": [0.75, 0.32, 0.2]})", "test.json");
    EXPECT_EQ(*material.meanFreePath, (Rgb{0.75, 0.32, 0.2}));
    const Material defaults;
    EXPECT_EQ(material.strength, defaults.strength);
    EXPECT_EQ(material.albedo, defaults.albedo);
    EXPECT_EQ(material.albedoUse, defaults.albedoUse);
    EXPECT_EQ(material.secondSurfaces, std::nullopt);
}

std::string withSlab(const std::string& slab, const std::string& more = "") {
    return R"({"slabs": [)" + slab + "]" + more + "}";
}

TEST(MaterialFile, ReadsSlabs) {
    const Material material = parseMaterial(R"({"slabs": [
        {"absorption": [0.1, 0.2, 0.3], "scattering": [10, 20, 30], "anisotropy": [0.9, 0.8, 0.75], "thickness": 0.25},
        {"absorption": [0, 0, 0], "reducedScattering": [1, 2, 3], "refractiveIndex": 1.3, "thickness": 2},
        {"skin": {"haemoglobin": 0.05, "oxygenation": 0.5, "water": 0.6}, "thickness": "infinite"}]})",
                                            "test.json");
    ASSERT_EQ(material.slabs.size(), 3u);
    const Medium& scattering = material.slabs[0].medium;
    EXPECT_EQ(scattering.absorption, (Rgb{0.1, 0.2, 0.3}));
    EXPECT_NEAR(scattering.reducedScattering[0], 1, 1e-12);
    EXPECT_NEAR(scattering.reducedScattering[2], 7.5, 1e-12);
    EXPECT_EQ(scattering.anisotropy, (Rgb{0.9, 0.8, 0.75}));
    EXPECT_EQ(scattering.refractiveIndex, tissueRefractiveIndex);
    EXPECT_EQ(material.slabs[0].thickness, 0.25);
    EXPECT_EQ(material.slabs[1].medium.reducedScattering, (Rgb{1, 2, 3}));
    EXPECT_EQ(material.slabs[1].medium.refractiveIndex, 1.3);
    const SkinContent dermis{.haemoglobin = 0.05, .oxygenation = 0.5, .water = 0.6};
    EXPECT_EQ(material.slabs[2].skin, dermis);
    EXPECT_EQ(material.slabs[2].medium, makeSkinSlab(dermis, 1).medium);
    EXPECT_TRUE(std::isinf(material.slabs[2].thickness));
    EXPECT_EQ(material.layers, layersOf(material.slabs));
    EXPECT_EQ(material.albedo, LayeredMedium(material.slabs).diffuseReflectance());
    EXPECT_LT(material.specular, 0.5); // an index below 1.5

    // What the file says itself goes before what follows from the slabs, and everything survives being saved.
    const Material own =
        parseMaterial(withSlab(R"({"absorption": [0.1, 0.1, 0.1], "reducedScattering": [1, 1, 1], "thickness": 3})",
                               R"(, "albedo": [0.5, 0.25, 0.125], "specular": 0.75)"),
                      "test.json");
    EXPECT_EQ(own.albedo, (Rgb{0.5, 0.25, 0.125}));
    EXPECT_EQ(own.specular, 0.75);
    for (const Material& saved : {material, own}) {
        EXPECT_EQ(parseMaterial(formatMaterial(saved), "saved.json"), saved);
        EXPECT_EQ(formatMaterial(saved).find("\"layers\""), std::string::npos);
    }
    Material changed = own;
    changed.layers[0].variance *= 2;
    EXPECT_THROW(formatMaterial(changed), FileError);
}

TEST(MaterialFile, RefusesSlabsInOneSentence) {
    const std::string half = R"("absorption": [0, 0, 0], "reducedScattering": [1, 1, 1])";
    const std::pair<std::string, std::string> cases[] = {
        {withSlab(""), "test.json: slabs has 0 entries, must have 1 to 32"},
        {withSlab("{" + half + "}"), "test.json: slabs[0].thickness is missing"},
        {withSlab("{" + half + R"(, "thickness": "thick"})"),
         "test.json: slabs[0].thickness is \"thick\", must be a number of mm or \"infinite\""},
        {withSlab("{" + half + R"(, "thickness": 0})"),
         "test.json: slabs[0].thickness is 0, must be in [1e-06, inf] mm"},
        {withSlab("{" + half + R"(, "thickness": "infinite"}, {)" + half + R"(, "thickness": 1})"),
         "test.json: slabs[0].thickness is infinite, which only the last may be"},
        {withSlab(R"({"reducedScattering": [1, 1, 1], "thickness": 1})"),
         "test.json: slabs[0].absorption is missing, and there is no skin in its place"},
        {withSlab(R"({"absorption": [0, 0, 0], "thickness": 1})"),
         "test.json: slabs[0].reducedScattering is missing, and there is no scattering in its place"},
        {withSlab(R"({"absorption": [0, 0, 0], "scattering": [1, 1, 1], "thickness": 1})"),
         "test.json: slabs[0].anisotropy is missing, which scattering needs"},
        {withSlab("{" + half + R"(, "scattering": [1, 1, 1], "thickness": 1})"),
         "test.json: slabs[0].scattering and slabs[0].reducedScattering are both given, only one may"},
        {withSlab("{" + half + R"(, "skin": {}, "thickness": 1})"),
         "test.json: slabs[0].skin and slabs[0].absorption are both given, only one may describe what absorbs"},
        {withSlab(R"({"skin": {"melanin": 7}, "thickness": 1})"),
         "test.json: slabs[0].skin.melanin is 7, must be in [0, 1]"},
        {withSlab(R"({"skin": {"melanine": 0.1}, "thickness": 1})"),
         "test.json: the key \"slabs[0].skin.melanine\" is unknown"},
        {withSlab(R"({"absorption": [0, -1, 0], "reducedScattering": [1, 1, 1], "thickness": 1})"),
         "test.json: slabs[0].absorption[1] is -1, must be in [0, 1000000] 1/mm"},
        {withSlab("{" + half + R"(, "thickness": 1})", R"(, "meanFreePath": [1, 1, 1])"),
         "test.json: slabs and meanFreePath are both given, only one may describe the profile"},
        {withSlab("{" + half + R"(, "thickness": 1})", R"(, "layers": )" + oneLayer),
         "test.json: slabs and layers are both given, only one may describe the profile"},
    };
    for (const auto& [json, sentence] : cases) {
        EXPECT_EQ(faultOf(json), sentence) << json;
    }
}

TEST(MaterialFile, RefusesInOneSentenceNamingFileAndField) {
    std::string many = "[";
    for (int i = 0; i < 33; ++i) {
        many += std::string(i > 0 ? "," : "") + R"({"weight": [1, 1, 1], "variance": 1})";
    }
    const std::pair<std::string, std::string> cases[] = {
        {withLayers(oneLayer, R"(, "strenght": 1)"), "test.json: the key \"strenght\" is unknown"},
        {withLayers(R"([{"weight": [1, 1, 1], "variance": 1, "sigma": 1}])"),
         "test.json: the key \"layers[0].sigma\" is unknown"},
        {withLayers(oneLayer, R"(, "scale": 1, "scale": 2)"), "test.json: the key \"scale\" is given twice"},
        {withLayers(R"([{"weight": [1, 1, 1], "variance": 1}, {"weight": [1, 1, 1], "variance": -1}])"),
         "test.json: layers[1].variance is -1, must be in [0, 4e+09] mm²"},
        {withLayers(many + "]"), "test.json: layers has 33 entries, must have 1 to 32"},
        {withLayers("[]"), "test.json: layers has 0 entries, must have 1 to 32"},
        {withLayers("3"), "test.json: layers is no array, must have 1 to 32"},
        {withLayers(R"([{"weight": [1, 0, 1], "variance": 1}])"),
         "test.json: layers: the green weights sum to 0, must sum to more than 0"},
        {withLayers(R"([{"weight": [1, -1, 1], "variance": 1}])"),
         "test.json: layers[0].weight[1] is -1, must be in [0, 1000000]"},
        {withLayers(R"([{"weight": [1, 1], "variance": 1}])"),
         "test.json: layers[0].weight is [1,1], must be three numbers: red, green, blue"},
        {withLayers(R"([{"weight": [1, 1, 1]}])"), "test.json: layers[0].variance is missing"},
        {withLayers(oneLayer, R"(, "strength": "high")"), "test.json: strength is \"high\", must be a number"},
        {withLayers(oneLayer, R"(, "strength": true)"), "test.json: strength is true, must be a number"},
        {withLayers(oneLayer, R"(, "strength": 1.5)"), "test.json: strength is 1.5, must be in [0, 1]"},
        {withLayers(oneLayer, R"(, "scale": 0)"), "test.json: scale is 0, must be in [1e-06, 10000]"},
        {withLayers(oneLayer, R"(, "name": 7)"), "test.json: name is 7, must be a string"},
        {withLayers(oneLayer, R"(, "secondSurfaces": 1)"), "test.json: secondSurfaces is 1, must be true or false"},
        {withLayers(oneLayer, R"(, "albedoUse": "pre")"),
         "test.json: albedoUse is \"pre\", must be \"post\" or \"preAndPost\""},
        {withLayers(oneLayer, R"(, "meanFreePath": [1, 1, 1])"),
         "test.json: layers and meanFreePath are both given, only one may describe the profile"},
        {R"({"name": "x"})",
         "test.json: layers, meanFreePath and slabs are all missing, one must describe the profile"},
        {R"({"meanFreePath": [1, 0, 1]})", "test.json: meanFreePath[1] is 0, must be in [1e-06, 10000] mm"},
        {R"({"meanFreePath": [100, 1, 1], "scale": 1000})",
         "test.json: scale·meanFreePath[0] is 100000, must be in [1e-06, 10000] mm"},
        {"[1]", "test.json: the material is [1], must be an object"},
    };
    for (const auto& [json, sentence] : cases) {
        EXPECT_EQ(faultOf(json), sentence) << json;
    }
}

TEST(MaterialFile, RefusesWhatIsNoJson) {
    for (const std::string json : {"", "{", R"({"meanFreePath": [NaN, 1, 1]})", R"({"meanFreePath": [1e999, 1, 1]})",
                                   "{} {}", "\xff\xfe", R"({"name": "\ud800"})"}) {
        const std::string fault = faultOf(json);
        EXPECT_TRUE(fault.starts_with("test.json: ")) << fault;
        EXPECT_EQ(fault.find("json.exception"), std::string::npos) << fault;
        EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    }
    EXPECT_EQ(faultOf(std::string(500'000, '[') + std::string(500'000, ']')),
              "test.json: is nested deeper than 16 levels");
}

class MaterialFiles : public testing::Test {
protected:
    const nacre::tests::TemporaryFolder temporary_;
    const std::filesystem::path& directory_ = temporary_.path;
};

TEST_F(MaterialFiles, SavesWhatItLoads) {
    const auto file = directory_ / "jelly.json";
    Material material;
    material.description = "a third is 1/3";
    material.layers = {{{1.0 / 3, 0.1, 1e-9}, 1.0 / 7}, {{0, 0, 1}, 0}};
    saveMaterial(material, file);
    const Material loaded = loadMaterial(file);
    EXPECT_EQ(loaded.name, "jelly");
    EXPECT_EQ(loaded.description, material.description);
    EXPECT_EQ(loaded.layers, material.layers);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 1);
}

TEST_F(MaterialFiles, WritesNothingWhenTheMaterialIsFaultyOrTheDirectoryIsMissing) {
    Material material;
    EXPECT_THROW(saveMaterial(material, directory_ / "none.json"), FileError);
    material.meanFreePath = {1, 1, 1};
    EXPECT_THROW(saveMaterial(material, directory_ / "missing" / "none.json"), FileError);
    material.name = "\xff";
    EXPECT_THROW(saveMaterial(material, directory_ / "none.json"), FileError);
    EXPECT_TRUE(std::filesystem::is_empty(directory_));
}

TEST_F(MaterialFiles, NamesTheFileThatCannotBeRead) {
    for (const auto& file : {directory_, directory_ / "missing.json"}) {
        try {
            loadMaterial(file);
            FAIL() << file;
        } catch (const FileError& error) {
            EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
        }
    }
    const auto large = directory_ / "large.json";
    std::ofstream(large) << std::string((1 << 20) + 1, ' ');
    EXPECT_THROW(loadMaterial(large), FileError);
}

} // namespace
