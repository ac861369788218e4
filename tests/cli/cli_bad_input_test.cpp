// Bad input of `nacre render`: exit code 1, one sentence that names the file or field, and nothing left behind.
#include "running_nacre.hpp"

#include <string>
#include <vector>

namespace {

using nacre::test::CommandTest;
using nacre::test::Environment;
using nacre::test::expectComplaint;
using nacre::test::Outcome;
using nacre::test::readText;
using nacre::test::writeText;

const std::string bunny = "/usr/share/glmark2/models/bunny.obj";
const std::string engine = "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb";

class BadInputTest : public CommandTest {
protected:
    void expectRefused(const std::vector<std::string>& arguments, const std::vector<std::string>& parts,
                       const Environment& environment = {}) const {
        const std::vector<std::string> before = files();
        std::vector<std::string> all{"render", "--size", "64x36", "--shadow-map-size", "64"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        expectComplaint(run(all, environment), 1, parts);
        EXPECT_EQ(files(), before);
    }
};

TEST_F(BadInputTest, MissingScene) {
    expectRefused({"none.glb"}, {"none.glb", "No such file"});
    expectRefused({"none.json"}, {"none.json", "No such file"});
    expectRefused({"."}, {"."});
}

TEST_F(BadInputTest, TruncatedGlb) {
    const std::string whole = readText(engine);
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{4}, std::size_t{11}, std::size_t{40}, whole.size() / 2, whole.size() - 1}) {
        writeText(folder() / "cut.glb", whole.substr(0, size));
        expectRefused({"cut.glb"}, {"cut.glb"});
    }
}

TEST_F(BadInputTest, NotAModel) {
    writeText(folder() / "noise.obj", std::string(1000, '\xff'));
    expectRefused({"noise.obj"}, {"noise.obj"});
    writeText(folder() / "noise.xyz", "hello");
    expectRefused({"noise.xyz"}, {"noise.xyz"});
}

TEST_F(BadInputTest, MissingTexture) {
    // One triangle, its base colour in a file that is not there.
    writeText(folder() / "triangle.gltf", R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": "missing-texture.png"}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36,
                     "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    expectRefused({"triangle.gltf"}, {"triangle.gltf", "missing-texture.png"});
}

TEST_F(BadInputTest, FaultyMaterialFile) {
    writeText(folder() / "negative.json", R"({"layers": [{"weight": [1, 1, 1], "variance": -1}]})");
    expectRefused({"--material", "negative.json"}, {"negative.json", "variance", "-1"});
    expectRefused({"--material", "none.json"}, {"none.json", "No such file"});
}

struct SceneFault {
    std::string name;
    std::string text;
    std::vector<std::string> parts;
};

std::string sceneWithMaterial(const std::string& material) {
    return R"({"models": [{"model": "cube.obj", "material": )" + material + "}]}";
}

std::string layers(int count) {
    std::string text;
    for (int layer = 0; layer < count; ++layer) {
        text += std::string(layer == 0 ? "" : ", ") + R"({"weight": [1, 1, 1], "variance": 1})";
    }
    return R"({"name": "m", "layers": [)" + text + "]}";
}

const std::vector<SceneFault> sceneFaults{
    {"NotJson", "{models", {}},
    {"Empty", "", {}},
    {"UnknownKey", R"({"models": [{"model": "cube.obj"}], "colour": 3})", {"colour"}},
    {"UnknownModelKey", R"({"models": [{"model": "cube.obj", "turn": 3}]})", {"turn"}},
    {"NoModels", R"({"models": []})", {"models"}},
    {"MissingModel", R"({"models": [{"model": "none.glb"}]})", {"none.glb"}},
    {"Nan", R"({"models": [{"model": "cube.obj", "scale": NaN}]})", {}},
    {"NegativeScale", R"({"models": [{"model": "cube.obj", "scale": -1}]})", {"scale", "-1"}},
    {"WrongType", R"({"models": [{"model": 7}]})", {"model"}},
    {"NegativeVariance",
     sceneWithMaterial(R"({"layers": [{"weight": [1, 1, 1], "variance": -2}]})"),
     {"variance", "-2"}},
    {"TooManyLayers", sceneWithMaterial(layers(33)), {"layers", "33"}},
    {"ZeroWeights", sceneWithMaterial(R"({"layers": [{"weight": [0, 0, 0], "variance": 1}]})"), {"weight"}},
    {"UnknownPreset", sceneWithMaterial(R"("custard")"), {"custard"}},
    {"MissingEnvironment",
     R"({"models": [{"model": "cube.obj"}], "environment": {"image": "none.hdr"}})",
     {"none.hdr"}},
};

class SceneFaultTest : public BadInputTest, public testing::WithParamInterface<SceneFault> {};

TEST_P(SceneFaultTest, IsOneSentenceThatNamesFileAndField) {
    writeText(folder() / "cube.obj", nacre::test::cubeObj);
    writeText(folder() / "faulty.json", GetParam().text);
    std::vector<std::string> parts = GetParam().parts;
    parts.emplace_back("faulty.json");
    expectRefused({"faulty.json"}, parts);
}

INSTANTIATE_TEST_SUITE_P(Scene, SceneFaultTest, testing::ValuesIn(sceneFaults),
                         [](const auto& test) { return test.param.name; });

TEST_F(BadInputTest, UnwritableOutput) {
    writeText(folder() / "plain", "");
    expectRefused({"-o", "missing/picture.png"}, {"missing/picture.png", "missing"});
    expectRefused({"-o", "plain/picture.png"}, {"plain/picture.png"});
    std::filesystem::create_directory(folder() / "folder.png");
    expectRefused({"-o", "folder.png"}, {"folder.png"});
    expectRefused({"--json", "missing/report.json"}, {"missing/report.json"});
    expectRefused({"--aov", "depth=missing/depth.exr"}, {"missing/depth.exr"});
}

TEST_F(BadInputTest, FullDisk) {
    std::filesystem::create_symlink("/dev/full", folder() / "full.png");
    std::filesystem::create_symlink("/dev/full", folder() / "full.exr");
    expectRefused({bunny, "-o", "full.png"}, {"full.png", "No space left"});
    expectRefused({bunny, "-o", "full.exr"}, {"full.exr", "No space left"});
}

TEST_F(BadInputTest, NoVulkanDevice) {
    const Environment none{{"VK_ICD_FILENAMES", "/nonexistent"}, {"VK_DRIVER_FILES", "/nonexistent"}};
    expectRefused({}, {"Vulkan"}, none);
    expectComplaint(run({"devices"}, none), 1, {"Vulkan"});
}

TEST_F(BadInputTest, UnknownDevice) {
    expectRefused({"--device", "quantum"}, {"quantum"});
    expectRefused({"--device", "99"}, {"99"});
}

TEST_F(BadInputTest, UnknownCameraAndLight) {
    expectRefused({bunny, "--camera", "nine"}, {"camera", "'nine'"});
    expectRefused({bunny, "--camera", "99"}, {"camera", "'99'"});
    expectRefused({bunny, "--light", "moon"}, {"light", "'moon'"});
    expectRefused({bunny, "--camera-position", "1,1,1", "--camera-target", "1,1,1"}, {"same point"});
}

TEST_F(BadInputTest, DevicesListsWhatRenderTakes) {
    const Outcome outcome = run({"devices"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_TRUE(outcome.output.starts_with("0  ")) << outcome.output;
    expectComplaint(run({"devices", "--json", "missing/devices.json"}), 1, {"missing/devices.json"});
}

} // namespace
