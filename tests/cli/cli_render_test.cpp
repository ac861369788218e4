// `nacre render` on real input: the gallery, models of the Debian packages, and the development models when present.
#include "command.hpp"
#include "schema.hpp"

#include "scene/image.hpp"

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

TEST_F(RenderTest, GalleryHasItsTrianglesAndMaterials) {
    const nlohmann::json report = render({});
    EXPECT_EQ(report["schemaVersion"], 1);
    EXPECT_EQ(report["scene"]["name"], "gallery");
    EXPECT_EQ(report["scene"]["triangleCount"], 436508);
    EXPECT_GE(report["scene"]["materialCount"], 5);
    const nlohmann::json& materials = report["scene"]["materials"];
    EXPECT_TRUE(
        std::ranges::any_of(materials, [](const nlohmann::json& material) { return material["layers"] == 10; }));
    EXPECT_EQ(report["settings"]["width"], width);
    EXPECT_FALSE(report["device"]["name"].get<std::string>().empty());
    EXPECT_FALSE(report["frame"]["passes"].empty());
    EXPECT_GT(report["frame"]["subsurfaceCoverage"], 0.02);
    EXPECT_LT(report["frame"]["subsurfaceCoverage"], 0.9);
    EXPECT_TRUE(report["validationMessages"].empty());
}

TEST_F(RenderTest, TheSameCommandGivesTheSamePicture) {
    render({"-o", "first.png"});
    render({"-o", "second.png"});
    EXPECT_EQ(readText(folder() / "first.png"), readText(folder() / "second.png"));
}

TEST_F(RenderTest, TheEffectCanBeLeftOut) {
    const nlohmann::json off = render({"--no-scatter", "--no-transmit", "-o", "off.png"});
    EXPECT_EQ(off["frame"]["scatterDispatches"], 0);
    EXPECT_EQ(off["frame"]["transmitDispatches"], 0);
    const nlohmann::json on = render({"-o", "on.png"});
    EXPECT_GT(on["frame"]["scatterDispatches"], 0);
    EXPECT_GT(on["frame"]["transmitDispatches"], 0);
    EXPECT_NE(picture("on.png").pixels, picture("off.png").pixels);
}

TEST_F(RenderTest, FrontAndBackLightDiffer) {
    const nlohmann::json front = render({"--front", "-o", "front.png"});
    const nlohmann::json back = render({"--light", "back", "-o", "back.png"});
    EXPECT_NE(front["scene"]["lights"], back["scene"]["lights"]);
    EXPECT_NE(picture("front.png").pixels, picture("back.png").pixels);
}

TEST_F(RenderTest, EveryModelCanBeLitFromBehind) {
    const std::string bunny = "/usr/share/glmark2/models/bunny.obj";
    const nlohmann::json back = render({bunny, "--material", "wax", "--back"});
    const nlohmann::json all = render({bunny, "--material", "wax"});
    EXPECT_GE(back["scene"]["lightCount"], 1);
    EXPECT_LT(back["scene"]["lightCount"], all["scene"]["lightCount"]);
}

TEST_F(RenderTest, CameraAndExposureChangeThePicture) {
    render({"-o", "default.png"});
    for (const std::vector<std::string>& change :
         {std::vector<std::string>{"--exposure", "-2"}, {"--fov", "20"}, {"--camera-position", "-3,4,5"}}) {
        std::vector<std::string> arguments{"-o", "changed.png"};
        arguments.insert(arguments.end(), change.begin(), change.end());
        render(arguments);
        EXPECT_NE(picture("changed.png").pixels, picture("default.png").pixels) << change.front();
    }
}

TEST_F(RenderTest, EveryAovIsWritten) {
    std::vector<std::string> arguments{"-o", "color.exr"};
    const std::vector<std::string> names{"irradiance", "scattered", "transmitted", "depth",   "normal",
                                         "material",   "thickness", "albedo",      "specular"};
    for (const std::string& name : names) {
        arguments.insert(arguments.end(), {"--aov", name + "=" + name + ".exr"});
    }
    const nlohmann::json report = render(arguments);
    EXPECT_EQ(report["files"].size(), names.size() + 1);
    for (const nlohmann::json& file : report["files"]) {
        const nacre::scene::FloatImage image = nacre::scene::readFloatImage(folder() / file["file"].get<std::string>());
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, height);
        const auto [low, high] = std::ranges::minmax(image.pixels);
        EXPECT_LT(low, high) << file;
    }
}

TEST_F(RenderTest, ValidationIsClean) {
    EXPECT_TRUE(render({"--validation"})["validationMessages"].empty());
}

TEST_F(RenderTest, OneAndTenLayersCostTheSameDispatches) {
    std::vector<nlohmann::json> frames;
    for (const int count : {1, 10}) {
        nlohmann::json layers = nlohmann::json::array();
        for (int layer = 1; layer <= count; ++layer) {
            layers.push_back({{"weight", {1, 1, 1}}, {"variance", 0.1 * layer}});
        }
        writeText(folder() / "layers.json", nlohmann::json{{"name", "layers"}, {"layers", layers}}.dump());
        frames.push_back(render({"/usr/share/glmark2/models/cat.3ds", "--material", "layers.json"})["frame"]);
    }
    EXPECT_EQ(frames[0]["scatterDispatches"], frames[1]["scatterDispatches"]);
    EXPECT_EQ(frames[0]["transmitDispatches"], frames[1]["transmitDispatches"]);
    EXPECT_EQ(frames[0]["passes"].size(), frames[1]["passes"].size());
}

} // namespace
