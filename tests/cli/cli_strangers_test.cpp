// What a file from a stranger may do to the terminal and to other files. Needs no more than parsing, but for the last.
#include "running_nacre.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace {

using nacre::test::CommandTest;
using nacre::test::expectComplaint;
using nacre::test::Outcome;
using nacre::test::readText;
using nacre::test::writeText;

class StrangersTest : public CommandTest {
protected:
    Outcome render(std::vector<std::string> arguments) const {
        std::vector<std::string> all{"render", "--size", "16x16", "--shadow-map-size", "16"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run(all);
    }

    /// A triangle whose positions are in `buffer`, seen by a camera of this name.
    void writeModel(const std::string& file, const std::string& buffer, const std::string& camera = "c") const {
        nlohmann::json json = nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0,
            "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "camera": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]})");
        json["buffers"] = {{{"byteLength", 36}, {"uri", buffer}}};
        json["nodes"][0]["name"] = camera;
        writeText(folder() / file, json.dump());
    }
};

constexpr const char* triangle =
    "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

void expectHarmless(const std::string& text) {
    for (const char character : text) {
        const auto byte = static_cast<unsigned char>(character);
        EXPECT_TRUE(byte >= 0x20 || byte == '\n') << static_cast<int>(byte) << " in " << text;
        EXPECT_NE(byte, 0x7f);
    }
    for (const char* mark : {"\xc2\x9b", "\xe2\x80\xae", "\xe2\x80\xa8", "\xe2\x81\xa6"}) {
        EXPECT_EQ(text.find(mark), std::string::npos) << text;
    }
}

// Escape and C1 sequences that colour, rename the window or move the cursor, and marks that turn text around.
const std::string evil = "\x1b]0;title\x07\x1b[31m\xc2\x9b\x7f\xe2\x80\xae\xe2\x80\xa8\xe2\x81\xa6\r\b";

TEST_F(StrangersTest, CannotReachTheTerminal) {
    writeModel("a.gltf", triangle, evil + "grün");
    const Outcome missing = render({"a.gltf", "--camera", "zzz"});
    expectComplaint(missing, 1, {"zzz", R"(\x1b]0;title\x07\x1b[31m\x9b\x7f\u202e\u2028\u2066 \x08)", "grün"});
    expectHarmless(missing.error);

    const nlohmann::json material{{"name", evil}, {"description", evil}, {"meanFreePath", {1, 1, 1}}};
    writeText(folder() / "m.json", material.dump());
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"material", "show", "m.json"}, {"material", "check", "m.json"}, {"material", "fit", "m.json"}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
        expectHarmless(outcome.output + outcome.error);
    }
    nlohmann::json faulty = material;
    faulty[evil] = 1;
    writeText(folder() / "faulty.json", faulty.dump());
    const Outcome unknown = run({"material", "check", "faulty.json"});
    EXPECT_EQ(unknown.exitCode, 1);
    expectHarmless(unknown.error);
    writeText(folder() / "scene.json", nlohmann::json{{"models", {{{"model", evil}}}}}.dump());
    expectHarmless(render({"scene.json"}).error);
}

TEST_F(StrangersTest, NamesOfFilesCannotEither) {
    const std::string model = evil + ".gltf";
    const std::string picture = evil + ".png";
    writeModel(model, triangle);
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"render", model, "--size", "16x16", "-o", picture},
             {"reference", model, "--material", "skin", "--size", "4x4", "--spp", "1", "-o", evil + ".exr"},
             {"bake", "thickness", model, "--material", "skin", "-o", evil + ".ply"},
             {"material", "show", "skin", "--json", evil + ".json"},
             {"material", "check", evil + ".json"},
             {"compare", picture, picture}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << arguments[0] << ": " << outcome.error;
        expectHarmless(outcome.output + outcome.error);
    }
}

TEST_F(StrangersTest, SeeNoWordsOfTheStandardLibrary) {
    std::filesystem::create_symlink("loop.json", folder() / "loop.json");
    for (const Outcome& outcome :
         {render({"loop.json"}), render({"--material", "loop.json"}), run({"material", "check", "loop.json"}),
          run({"material", "show", "skin", "--json", "loop.json"}), render({"-o", "loop.json/a.png"}),
          render({std::string(5000, 'x')}), render({"--material", std::string(5000, 'x')})}) {
        EXPECT_NE(outcome.exitCode, 0);
        EXPECT_EQ(outcome.error.find("filesystem error"), std::string::npos) << outcome.error;
        EXPECT_EQ(outcome.error.find("what()"), std::string::npos) << outcome.error;
    }
}

// Files that a scene is made of, at every depth, as an output: nothing is rendered, and every byte stays.
TEST_F(StrangersTest, CannotMakeAnOutputReplaceAnInput) {
    writeText(folder() / "buffer.png", std::string(36, '\0'));
    writeModel("own.gltf", "buffer.png");
    writeText(folder() / "cube.obj", std::string("mtllib cube.exr\n") + nacre::test::cubeObj);
    writeText(folder() / "cube.exr", "newmtl red\nKd 1 0 0\n");
    writeText(folder() / "soap.png", R"({"meanFreePath": [1, 1, 1]})");
    writeText(folder() / "scene.json",
              R"({"models": [{"model": "own.gltf"}, {"model": "cube.obj", "material": "soap.png"}]})");
    std::filesystem::create_symlink("buffer.png", folder() / "link.png");
    std::filesystem::create_hard_link(folder() / "soap.png", folder() / "twin.png");
    const std::vector<std::string> before = files();
    const std::vector<std::vector<std::string>> calls{
        {"own.gltf", "-o", "buffer.png"},     {"own.gltf", "-o", "./link.png"},
        {"own.gltf", "--json", "buffer.png"}, {"scene.json", "-o", "buffer.png"},
        {"scene.json", "-o", "soap.png"},     {"scene.json", "-o", "twin.png"},
        {"scene.json", "-o", "cube.exr"},     {"scene.json", "-o", "a.png", "--aov", "depth=cube.exr"},
        {"cube.obj", "-o", "cube.exr"}};
    for (const std::vector<std::string>& call : calls) {
        expectComplaint(render(call), 1, {"is made of this file"});
        EXPECT_EQ(files(), before);
    }
    EXPECT_EQ(readText(folder() / "buffer.png"), std::string(36, '\0'));
    EXPECT_EQ(readText(folder() / "soap.png"), R"({"meanFreePath": [1, 1, 1]})");
    expectComplaint(run({"material", "show", "soap.png", "--json", "twin.png"}), 2, {"same file", "twin.png"});
    expectComplaint(run({"material", "show", "soap.png", "--plot", "soap.png"}), 2, {"same file"});
    expectComplaint(run({"material", "fit", "soap.png", "--json", "soap.png"}), 2, {"same file"});
    EXPECT_EQ(readText(folder() / "twin.png"), R"({"meanFreePath": [1, 1, 1]})");
}

} // namespace
