// `nacre bake thickness` as a user runs it: textures, meshes, reports, and what it refuses. Needs no device.
#include "image/image_file.hpp"
#include "running_nacre.hpp"
#include "scene/import.hpp"
#include "schema.hpp"
#include "tests/support/gltf_builder.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <fstream>
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

/// A box of 1 x 1 x 0.02 m about the origin, whose front and back have the same place of the picture; its sides have no
/// area there.
std::vector<std::uint8_t> plateGlb(const nlohmann::json& material, bool coordinates = true) {
    nacre::test::GltfBuilder builder;
    std::vector<float> positions;
    std::vector<float> uvs;
    for (const float z : {0.01f, -0.01f}) {
        for (const auto& [x, y] :
             {std::pair(0.f, 0.f), std::pair(1.f, 0.f), std::pair(1.f, 1.f), std::pair(0.f, 1.f)}) {
            positions.insert(positions.end(), {x - 0.5f, y - 0.5f, z});
            uvs.insert(uvs.end(), {0.1f + 0.8f * x, 0.9f - 0.8f * y});
        }
    }
    std::vector<std::uint16_t> indices{0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6};
    for (std::uint16_t i = 0; i < 4; ++i) {
        const auto next = static_cast<std::uint16_t>((i + 1) % 4);
        for (const int corner : {i + 0, i + 4, next + 4, i + 0, next + 4, next + 0}) {
            indices.push_back(static_cast<std::uint16_t>(corner));
        }
    }
    nlohmann::json primitive{{"attributes", {{"POSITION", builder.addFloats(positions, "VEC3", 3)}}},
                             {"indices", builder.addIndices(indices)},
                             {"material", 0}};
    if (coordinates) {
        primitive["attributes"]["TEXCOORD_0"] = builder.addFloats(uvs, "VEC2", 2);
    }
    builder.setPrimitive(std::move(primitive));
    builder.json["materials"] = {material};
    return builder.glb();
}

class BakeCommandTest : public CommandTest {
protected:
    void SetUp() override {
        write("plate.glb", plateGlb({{"name", "plate"}}));
        writeText(folder() / "cube.obj", cubeObj);
    }
    void write(const std::string& name, const std::vector<std::uint8_t>& bytes) const {
        std::ofstream(folder() / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    Outcome bake(const std::vector<std::string>& more) const {
        std::vector<std::string> all{"bake", "thickness"};
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    }
    nlohmann::json report(const std::string& file) const {
        const std::string text = readText(folder() / file);
        expectMatchesSchema(text, "bake.schema.json");
        return nlohmann::json::parse(text);
    }
};

TEST_F(BakeCommandTest, WritesAPictureInMillimetres) {
    const Outcome outcome = bake({"plate.glb", "-o", "t.exr", "--size", "32x32", "--json", "t.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_EQ(files(), (std::vector<std::string>{"cube.obj", "plate.glb", "t.exr", "t.json"}));
    const nacre::Image image = nacre::readImage(folder() / "t.exr");
    const std::size_t thickness = nacre::findChannel(image, "MM").value();
    EXPECT_NEAR(image.at(16, 16)[thickness], 20, 1);
    EXPECT_EQ(image.at(0, 0)[nacre::findChannel(image, "A").value()], 0);
    EXPECT_GT(image.at(0, 0)[thickness], 0); // padded
    EXPECT_EQ(report("t.json")["law"], "neutral");
    EXPECT_EQ(report("t.json")["surface"], "plate");
}

// The texture that comes out is one that goes in: in a glTF file it gives the thickness back.
TEST_F(BakeCommandTest, TheTextureIsGltfs) {
    ASSERT_EQ(bake({"plate.glb", "-o", "t.png", "--size", "32x32", "--json", "t.json"}).exitCode, 0);
    const double factor = report("t.json")["thicknessFactor"];
    nlohmann::json material{{"name", "plate"}};
    material["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", factor},
                                                      {"thicknessTexture", {{"index", 0}}},
                                                      {"attenuationDistance", 0.01},
                                                      {"attenuationColor", {0.5, 0.4, 0.3}}};
    const std::vector<std::uint8_t> glb = plateGlb(material);
    // The same file as text, with the texture beside it.
    const std::size_t jsonSize = glb[12] | glb[13] << 8 | glb[14] << 16;
    nlohmann::json json = nlohmann::json::parse(glb.begin() + 20, glb.begin() + 20 + static_cast<long>(jsonSize));
    const std::vector<std::uint8_t> binary(glb.begin() + 28 + static_cast<long>(jsonSize), glb.end());
    write("plate.bin", binary);
    json["buffers"][0]["uri"] = "plate.bin";
    json["images"] = {{{"uri", "t.png"}}};
    json["textures"] = {{{"source", 0}}};
    json["extensionsUsed"] = {"KHR_materials_volume"};
    writeText(folder() / "textured.gltf", json.dump());
    const nacre::scene::Scene scene = nacre::scene::load(folder() / "textured.gltf");
    const nacre::scene::Surface& surface = scene.surfaces.at(0);
    ASSERT_NE(surface.thicknessTexture, nacre::scene::none);
    const nacre::scene::Texture& texture = scene.textures[surface.thicknessTexture];
    const double green = texture.pixels[(16 * std::size_t{texture.width} + 16) * 4 + 1] / 255.0;
    EXPECT_NEAR(green * surface.thickness, 20, 1.1);
}

TEST_F(BakeCommandTest, WritesAMeshWithAValueAVertex) {
    const Outcome outcome = bake({"cube.obj", "--material", "marble", "-o", "c.ply", "--rays", "16"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.error;
    EXPECT_NE(outcome.output.find("vertices"), std::string::npos) << outcome.output;
    EXPECT_NE(readText(folder() / "c.ply").find("property float thickness"), std::string::npos);
    const nacre::scene::Scene scene = nacre::scene::load(folder() / "c.ply");
    EXPECT_EQ(triangleCount(scene), 12u);
}

TEST_F(BakeCommandTest, NotesStandInTheReport) {
    writeText(folder() / "large.obj", nacre::test::largeObj);
    const Outcome outcome = bake({"large.obj", "-o", "c.ply", "--rays", "1", "--json", "c.json"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.error;
    const nlohmann::json scene = report("c.json").at("scene");
    EXPECT_EQ(scene.at("name"), "large.obj");
    ASSERT_EQ(scene.at("notes").size(), 1u);
    const auto note = scene["notes"][0].get<std::string>();
    EXPECT_NE(note.find("large.obj: does not state its unit"), std::string::npos) << note;
    EXPECT_NE(outcome.error.find("nacre: note: " + note + '\n'), std::string::npos) << outcome.error;
    ASSERT_EQ(bake({"plate.glb", "-o", "t.exr", "--size", "8x8", "--rays", "1", "--json", "t.json"}).exitCode, 0);
    EXPECT_TRUE(report("t.json").at("scene").at("notes").empty());
}

TEST_F(BakeCommandTest, RefusesWhatHasNoPlaceInAPicture) {
    expectComplaint(bake({"cube.obj", "-o", "t.png"}), 1, {"cube.obj", "no texture coordinates", ".ply"});
    expectComplaint(bake({"plate.glb", "--surface", "skin"}), 1, {"plate.glb", "'skin'", "'plate'"});
    expectComplaint(bake({"nowhere.glb"}), 1, {"nowhere.glb"});
    expectComplaint(bake({"plate.glb", "--size", "8x8", "-o", "no/t.exr"}), 1, {"no"});
    EXPECT_EQ(files(), (std::vector<std::string>{"cube.obj", "plate.glb"}));
}

TEST_F(BakeCommandTest, InterruptedItKeepsWhatItHas) {
    const RunningNacre running({"bake", "thickness", "plate.glb", "--rays", "65536", "-o", "t.exr"}, folder());
    for (int i = 0; i < 600 && !std::filesystem::exists(folder() / "t.exr.checkpoint"); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    running.send(SIGTERM);
    const Outcome outcome = running.wait();
    EXPECT_EQ(outcome.exitCode, 128 + SIGTERM);
    EXPECT_NE(outcome.error.find("--resume"), std::string::npos) << outcome.error;
    EXPECT_FALSE(std::filesystem::exists(folder() / "t.exr"));
    expectComplaint(bake({"plate.glb", "-o", "t.exr"}), 1, {"t.exr.checkpoint", "--resume", "--restart"});
    expectComplaint(bake({"plate.glb", "-o", "t.exr", "--resume"}), 1,
                    {"t.exr.checkpoint", "rays", "'65536'", "'256'"});
    writeText(folder() / "t.exr.checkpoint", readText(folder() / "t.exr.checkpoint").substr(0, 200));
    expectComplaint(bake({"plate.glb", "-o", "t.exr", "--resume"}), 1, {"t.exr.checkpoint", "damaged"});
    EXPECT_EQ(bake({"plate.glb", "-o", "t.exr", "--restart", "--size", "8x8", "--rays", "4"}).exitCode, 0);
    EXPECT_EQ(files(), (std::vector<std::string>{"cube.obj", "plate.glb", "t.exr"}));
}

} // namespace
