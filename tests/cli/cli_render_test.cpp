// `nacre render` on real input: the gallery, models of the Debian packages, and the development models when present.
#include "running_nacre.hpp"
#include "schema.hpp"

#include "image/image_file.hpp"
#include "scene/texture.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace {

using nacre::test::CommandTest;
using nacre::test::Outcome;
using nacre::test::readText;
using nacre::test::writeText;

namespace fs = std::filesystem;

const std::string bunny = "/usr/share/glmark2/models/bunny.obj";
constexpr int width = 64;
constexpr int height = 36;

class RenderTest : public CommandTest {
protected:
    /// Renders small, expects success, and returns the report.
    nlohmann::json render(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "render");
        for (const char* argument : {"--size", "64x36", "--shadow-map-size", "256", "--json", "report.json"}) {
            arguments.emplace_back(argument);
        }
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
        EXPECT_TRUE(nacre::test::complaints(outcome).empty()) << outcome.error;
        if (outcome.exitCode != 0) {
            return {};
        }
        const std::string report = readText(folder() / "report.json");
        nacre::test::expectMatchesSchema(report, "report.schema.json");
        return nlohmann::json::parse(report);
    }

    nacre::scene::Texture picture(const std::string& name = "nacre.png") const {
        return nacre::scene::readTexture(folder() / name, true);
    }

    std::size_t colourCount(const std::string& name = "nacre.png") const {
        const nacre::scene::Texture image = picture(name);
        std::set<std::uint32_t> colours;
        for (std::size_t pixel = 0; pixel < image.pixels.size(); pixel += 4) {
            colours.insert(image.pixels[pixel] << 16U | image.pixels[pixel + 1] << 8U | image.pixels[pixel + 2]);
        }
        return colours.size();
    }
};

class ModelTest : public RenderTest, public testing::WithParamInterface<std::string> {};

TEST_P(ModelTest, IsRenderedAsSubsurface) {
    const nlohmann::json report = render({GetParam(), "--material", "marble"});
    EXPECT_EQ(picture().width, width);
    EXPECT_EQ(picture().height, height);
    EXPECT_GT(colourCount(), 50U);
    EXPECT_GT(report["scene"]["triangleCount"], 0);
    EXPECT_GT(report["scene"]["lightCount"], 0);
    EXPECT_GT(report["frame"]["subsurfaceCoverage"], 0.01);
    EXPECT_GT(report["frame"]["totalMicroseconds"], 0);
    EXPECT_EQ(files(), (std::vector<std::string>{"nacre.png", "report.json"}));
}

std::vector<std::string> models() {
    const std::string glmark = "/usr/share/glmark2/models/";
    const std::string assimp = "/usr/share/assimp/models/";
    std::vector<std::string> result{glmark + "bunny.obj",
                                    glmark + "horse.3ds",
                                    glmark + "cat.3ds",
                                    assimp + "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
                                    assimp + "glTF2/BoxTextured-glTF/BoxTextured.gltf",
                                    assimp + "glTF2/draco/2CylinderEngine.gltf",
                                    assimp + "PLY/Wuson.ply",
                                    assimp + "STL/Spider_binary.stl"};
    std::error_code error;
    const std::set<std::string> meshes{".glb", ".gltf", ".ply", ".obj"};
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(NACRE_SOURCE_DIR "/../shared/models", error)) {
        if (meshes.contains(entry.path().extension().string())) {
            result.push_back(entry.path().string());
        }
    }
    return result;
}

std::string testName(const testing::TestParamInfo<std::string>& info) {
    std::string name = fs::path(info.param).filename().string() + "_" + std::to_string(info.index);
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Real, ModelTest, testing::ValuesIn(models()), testName);

TEST_F(RenderTest, GalleryHasItsTrianglesAndMaterialsWhichOneReplaces) {
    const nlohmann::json report = render({});
    EXPECT_EQ(report["schemaVersion"], 1);
    EXPECT_EQ(report["scene"]["name"], "gallery");
    EXPECT_EQ(report["scene"]["triangleCount"], 436508);
    EXPECT_GE(report["scene"]["materialCount"], 5);
    const nlohmann::json& materials = report["scene"]["materials"];
    EXPECT_TRUE(
        std::ranges::any_of(materials, [](const nlohmann::json& material) { return material["layers"] == 10; }));
    EXPECT_TRUE(std::ranges::none_of(
        materials, [](const nlohmann::json& material) { return material["secondSurfaces"] == true; }));
    EXPECT_EQ(report["settings"]["width"], width);
    EXPECT_FALSE(report["device"]["name"].get<std::string>().empty());
    EXPECT_FALSE(report["frame"]["passes"].empty());
    EXPECT_GT(report["frame"]["subsurfaceCoverage"], 0.02);
    EXPECT_LT(report["frame"]["subsurfaceCoverage"], 0.9);
    EXPECT_TRUE(report["validationMessages"].empty());
    // Another material replaces those of the bodies, and of nothing else.
    const nlohmann::json one = render({"--material", "wax"});
    EXPECT_EQ(one["scene"]["materialCount"], 1);
    EXPECT_EQ(one["scene"]["materials"][0]["secondSurfaces"], true);
    EXPECT_EQ(one["frame"]["subsurfaceCoverage"], report["frame"]["subsurfaceCoverage"]);
}

TEST_F(RenderTest, TheSameCommandGivesTheSamePicture) {
    render({bunny, "--material", "wax", "-o", "first.png"});
    render({bunny, "--material", "wax", "-o", "second.png"});
    EXPECT_EQ(readText(folder() / "first.png"), readText(folder() / "second.png"));
}

TEST_F(RenderTest, TheEffectCanBeLeftOut) {
    const nlohmann::json off = render({bunny, "--material", "wax", "--no-scatter", "--no-transmit", "-o", "off.png"});
    EXPECT_EQ(off["frame"]["scatterDispatches"], 0);
    EXPECT_EQ(off["frame"]["transmitDispatches"], 0);
    const nlohmann::json on = render({bunny, "--material", "wax", "-o", "on.png"});
    EXPECT_GT(on["frame"]["scatterDispatches"], 0);
    EXPECT_GT(on["frame"]["transmitDispatches"], 0);
    EXPECT_NE(picture("on.png").pixels, picture("off.png").pixels);
}

TEST_F(RenderTest, TheGalleryIsLitFromEitherSide) {
    const nlohmann::json front = render({"--front", "-o", "front.png"});
    const nlohmann::json back = render({"--light", "back", "-o", "back.png"});
    EXPECT_EQ(front["scene"]["lightCount"].get<int>() + back["scene"]["lightCount"].get<int>(), 3);
    EXPECT_NE(picture("front.png").pixels, picture("back.png").pixels);
}

TEST_F(RenderTest, ALightChosenTwiceShinesOnce) {
    const nlohmann::json all = render({bunny})["scene"]["lights"];
    EXPECT_EQ(render({bunny, "--front", "--back"})["scene"]["lights"], all);
    EXPECT_EQ(render({bunny, "--light", "both", "--back", "--light", all[0]})["scene"]["lights"], all);
}

TEST_F(RenderTest, EveryModelCanBeLitFromBehind) {
    const nlohmann::json all = render({bunny, "--material", "wax"});
    const nlohmann::json back = render({bunny, "--material", "wax", "--back"});
    EXPECT_GE(back["scene"]["lightCount"], 1);
    EXPECT_LT(back["scene"]["lightCount"], all["scene"]["lightCount"]);
    const nlohmann::json named = render({bunny, "--light", back["scene"]["lights"][0]});
    EXPECT_EQ(named["scene"]["lights"], nlohmann::json::array({back["scene"]["lights"][0]}));
}

TEST_F(RenderTest, CameraExposureAndSamplesChangeThePicture) {
    render({bunny, "-o", "default.png"});
    for (const std::vector<std::string>& change : {std::vector<std::string>{"--exposure", "-2"},
                                                   {"--fov", "20"},
                                                   {"--camera-position", "-3,4,5"},
                                                   {"--samples", "2"}}) {
        std::vector<std::string> arguments{bunny, "-o", "changed.png"};
        arguments.insert(arguments.end(), change.begin(), change.end());
        render(arguments);
        EXPECT_EQ(picture("changed.png").width, width);
        EXPECT_NE(picture("changed.png").pixels, picture("default.png").pixels) << change.front();
    }
}

TEST_F(RenderTest, EveryAovIsWritten) {
    std::vector<std::string> arguments{bunny, "--material", "wax", "-o", "color.exr"};
    const std::vector<std::string> names{"irradiance", "scattered", "transmitted", "depth",   "normal",
                                         "material",   "thickness", "albedo",      "specular"};
    for (const std::string& name : names) {
        arguments.insert(arguments.end(), {"--aov", name + "=" + name + ".exr"});
    }
    const nlohmann::json report = render(arguments);
    EXPECT_EQ(report["files"].size(), names.size() + 1);
    for (const nlohmann::json& file : report["files"]) {
        const nacre::Image image = nacre::readImage(folder() / file["file"].get<std::string>());
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, height);
        const auto [low, high] = std::ranges::minmax(image.values);
        EXPECT_LT(low, high) << file;
    }
}

TEST_F(RenderTest, AnExrOfManySamplesHasTheSizeAndLightOfThePicture) {
    const auto mean = [&](const char* samples) {
        render({bunny, "--samples", samples, "-o", "color.exr"});
        const nacre::Image image = nacre::readImage(folder() / "color.exr");
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, height);
        double sum = 0;
        for (const float value : image.values) {
            sum += value;
        }
        return sum / static_cast<double>(image.values.size());
    };
    const double one = mean("1");
    EXPECT_NEAR(mean("3"), one, 0.05 * one);
}

TEST_F(RenderTest, ValidationIsClean) {
    EXPECT_TRUE(render({bunny, "--material", "wax", "--validation"})["validationMessages"].empty());
}

void expectSameDispatches(const nlohmann::json& one, const nlohmann::json& other) {
    EXPECT_GT(one["scatterDispatches"], 0);
    EXPECT_GT(one["transmitDispatches"], 0);
    EXPECT_EQ(one["scatterDispatches"], other["scatterDispatches"]);
    EXPECT_EQ(one["transmitDispatches"], other["transmitDispatches"]);
    EXPECT_EQ(one["passes"].size(), other["passes"].size());
}

nlohmann::json layerOf(double variance) {
    return {{"weight", {1, 1, 1}}, {"variance", variance}};
}

/// Eight by eight cubes of 40 mm, each of its own material.
std::string cubesScene() {
    nlohmann::json cubes = nlohmann::json::array();
    for (int cube = 0; cube < 64; ++cube) {
        const nlohmann::json material{{"name", "material " + std::to_string(cube)},
                                      {"layers", {layerOf(0.1 * (1 + cube))}}};
        cubes.push_back({{"model", "cube.obj"},
                         {"units", "m"},
                         {"scale", 0.04},
                         {"translate", {0.06 * (cube % 8), 0.06 * (cube / 8), 0}},
                         {"material", material}});
    }
    return nlohmann::json{{"name", "cubes"}, {"models", cubes}}.dump();
}

TEST_F(RenderTest, SaysOnceWhatTheImporterAssumed) {
    writeText(folder() / "large.obj", nacre::test::largeObj);
    writeText(folder() / "guessed.json", R"({"models": [{"model": "large.obj"}, {"model": "large.obj"}]})");
    writeText(folder() / "stated.json", R"({"models": [{"model": "large.obj", "units": "cm"}]})");
    const std::string note = "large.obj: does not state its unit; taken for centimetres\n";
    const auto saidBy = [&](const char* scene) { return run({"render", scene, "--size", "16x9"}).error; };
    const std::string said = saidBy("guessed.json");
    EXPECT_NE(said.find("nacre: note: "), std::string::npos) << said;
    EXPECT_NE(said.find(note), std::string::npos) << said;
    EXPECT_EQ(said.find(note), said.rfind(note)) << said;
    EXPECT_EQ(saidBy("stated.json").find("note"), std::string::npos);
    const Outcome reported = run({"render", "guessed.json", "--size", "16x9", "--json", "-"});
    const nlohmann::json notes = nlohmann::json::parse(reported.output).at("scene").at("notes");
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].get<std::string>().find("taken for centimetres"), std::string::npos);
}

TEST_F(RenderTest, OneAndSixtyFourMaterialsCostTheSameDispatches) {
    writeText(folder() / "cube.obj", nacre::test::cubeObj);
    writeText(folder() / "cubes.json", cubesScene());
    for (const std::string technique : {"bank", "separable", "burley", "brute"}) {
        const nlohmann::json many = render({"cubes.json", "--technique", technique});
        const nlohmann::json one = render({"cubes.json", "--technique", technique, "--material", "wax"});
        EXPECT_EQ(many["scene"]["materialCount"], 64);
        EXPECT_EQ(one["scene"]["materialCount"], 1);
        EXPECT_EQ(one["settings"]["technique"], technique);
        EXPECT_EQ(one["frame"]["subsurfaceCoverage"], many["frame"]["subsurfaceCoverage"]);
        expectSameDispatches(one["frame"], many["frame"]);
    }
}

TEST_F(RenderTest, OneAndTenLayersCostTheSameDispatches) {
    std::vector<nlohmann::json> frames;
    for (const int count : {1, 10}) {
        nlohmann::json layers = nlohmann::json::array();
        for (int layer = 1; layer <= count; ++layer) {
            layers.push_back(layerOf(0.1 * layer));
        }
        writeText(folder() / "layers.json", nlohmann::json{{"name", "layers"}, {"layers", layers}}.dump());
        frames.push_back(render({"/usr/share/glmark2/models/cat.3ds", "--material", "layers.json"})["frame"]);
    }
    expectSameDispatches(frames[0], frames[1]);
}

} // namespace
