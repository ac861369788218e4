// glTF files that mean harm: numbers that do not fit, small files that unfold to much, files that are not theirs.
#include "scene/load_budget.hpp"

#include "tests/support/gltf_builder.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

using namespace nacre::scene;
using nacre::test::GltfBuilder;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t wrapped = std::uint64_t{1} << 32; // 0 modulo 2^32

/// Sets one member of a valid square to `value`; the error that loading ends with.
std::string errorWith(const std::string& pointer, const Json& value) {
    GltfBuilder builder;
    builder.setSquare()["material"] = 0;
    builder.json["materials"] = {
        {{"normalTexture", {{"index", 0}}}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"bufferView", 0}}};
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    builder.json[Json::json_pointer(pointer)] = value;
    return builder.error();
}

TEST(GltfStrangers, MayNotUseNumbersBeyondAnInt) {
    for (const char* pointer : {"/scene",
                                "/scenes/0/nodes/0",
                                "/nodes/0/mesh",
                                "/nodes/0/camera",
                                "/nodes/0/skin",
                                "/nodes/0/children",
                                "/meshes/0/primitives/0/indices",
                                "/meshes/0/primitives/0/material",
                                "/meshes/0/primitives/0/mode",
                                "/meshes/0/primitives/0/attributes/POSITION",
                                "/accessors/0/bufferView",
                                "/accessors/0/byteOffset",
                                "/accessors/0/count",
                                "/accessors/0/componentType",
                                "/bufferViews/0/buffer",
                                "/bufferViews/0/byteOffset",
                                "/bufferViews/0/byteLength",
                                "/textures/0/source",
                                "/textures/0/sampler",
                                "/images/0/bufferView",
                                "/materials/0/normalTexture/index",
                                "/materials/0/normalTexture/texCoord",
                                "/materials/0/pbrMetallicRoughness/baseColorTexture/index"}) {
        for (const std::uint64_t value : {wrapped, wrapped + 1, std::uint64_t{1} << 31, std::uint64_t{1} << 63}) {
            const bool isList = std::string(pointer).ends_with("children");
            const std::string error = errorWith(pointer, isList ? Json::array({value}) : Json(value));
            EXPECT_TRUE(error.starts_with("test.glb: ")) << pointer << " " << value << ": " << error;
        }
    }
}

TEST(GltfStrangers, MayNotUseNumbersBeyondAnIntInExtensions) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = wrapped;
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    EXPECT_EQ(builder.error(),
              "test.glb: nodes[0].extensions.KHR_lights_punctual.light must be a whole number, 0 or more");
    // What is a length may be as large as it likes, and keeps its value.
    builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    builder.json["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = 10 * wrapped;
    EXPECT_FLOAT_EQ(builder.load().lights.at(0).range, 10.0f * static_cast<float>(wrapped));
}

TEST(GltfStrangers, MayNotUnfoldAccessorsWithoutBytes) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["accessors"][0].erase("bufferView");
    builder.json["accessors"][0]["count"] = 16777216;
    builder.json["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}}}};
    EXPECT_EQ(builder.error(), "test.glb: accessors[0].count is 16777216, must be at most 1024");
}

// A few bytes that would decompress to a gibibyte.
TEST(GltfStrangers, MayNotUnfoldCompressedViews) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},      {"byteOffset", 0},   {"byteLength", 16},
        {"byteStride", 64}, {"count", 16777216}, {"mode", "ATTRIBUTES"}};
    EXPECT_EQ(builder.error(), "test.glb: needs more than 512 MiB of memory, which its size does not explain");
}

// A thousand instances of a node whose name has a megabyte, and a thousand nodes that share a skin of as many joints.
TEST(GltfStrangers, MayNotUnfoldByRepeating) {
    GltfBuilder named;
    named.setSquare();
    const auto places = named.addFloats(std::vector<float>(30'000), "VEC3", 3);
    named.json["nodes"][0]["name"] = std::string(1'000'000, 'n');
    named.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    EXPECT_TRUE(named.error().starts_with("test.glb: needs more than ")) << named.error().substr(0, 100);

    constexpr int count = 5000;
    GltfBuilder skinned;
    auto& attributes = skinned.setSquare()["attributes"];
    attributes["JOINTS_0"] =
        skinned.addAccessor(skinned.addView(std::vector<std::uint8_t>(16, std::uint8_t{0})), 5121, 4, "VEC4");
    attributes["WEIGHTS_0"] = skinned.addFloats(std::vector<float>(16, 0.25f), "VEC4", 4);
    std::vector<int> joints(count);
    for (int i = 0; i < count; ++i) {
        joints[static_cast<std::size_t>(i)] = i;
        skinned.json["nodes"][static_cast<std::size_t>(i)] = {{"mesh", 0}, {"skin", 0}};
    }
    skinned.json["scenes"][0]["nodes"] = joints;
    skinned.json["skins"] = {{{"joints", joints}}};
    EXPECT_TRUE(skinned.error().starts_with("test.glb: needs more than ")) << skinned.error().substr(0, 100);
}

TEST(GltfStrangers, MayTakeMemoryInProportion) {
    LoadBudget budget("file");
    budget.addInput(std::uint64_t{1} << 20);
    budget.charge(std::uint64_t{767} << 20);
    budget.charge(std::uint64_t{1} << 20);
    EXPECT_THROW(budget.charge(1), SceneError);
    Mesh mesh;
    mesh.vertices.resize(1000);
    mesh.indices.resize(3000);
    LoadBudget meshes("file");
    int count = 0;
    EXPECT_THROW(
        for (;; ++count) { meshes.charge(mesh); }, SceneError);
    EXPECT_EQ(count, (512 << 20) / static_cast<int>(1000 * sizeof(Vertex) + 3000 * sizeof(std::uint32_t)));
}

class GltfFiles : public testing::Test {
protected:
    /// A triangle whose buffer is `uri`, in the folder "model".
    std::string error(const std::string& uri) const {
        GltfBuilder builder;
        builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
        builder.setPrimitive({{"attributes", {{"POSITION", 0}}}});
        builder.json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        const std::string text = builder.json.dump();
        try {
            loadGltf(folder / "model/a.gltf", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
        } catch (const SceneError& failure) {
            return failure.what();
        }
        return "";
    }

    void SetUp() override {
        fs::create_directory(folder / "model");
        for (const char* name : {"model/b.bin", "model/b c.bin", "secret.bin"}) {
            std::ofstream(folder / name) << std::string(36, '\0');
        }
    }

    const nacre::tests::TemporaryFolder temporary;
    const fs::path& folder = temporary.path;
};

TEST_F(GltfFiles, NameOnlyWhatIsTheirs) {
    EXPECT_EQ(error("b.bin"), "");
    EXPECT_EQ(error("b%20c.bin"), "");
    for (const char* uri : {"../secret.bin", "%2e%2e/secret.bin", "%2E%2e%2fsecret.bin", "..%5csecret.bin",
                            "..\\secret.bin", "b.bin/../../secret.bin"}) {
        const std::string sentence = error(uri);
        EXPECT_TRUE(sentence.find("buffers[0].uri") != std::string::npos &&
                    (sentence.ends_with("lies outside the folder of the file that names it") ||
                     sentence.ends_with("does not exist")))
            << uri << ": " << sentence;
    }
    EXPECT_NE(error("/etc/passwd").find("is not a path relative to the file"), std::string::npos);
    EXPECT_NE(error("file:///etc/passwd").find("does not exist"), std::string::npos);
    EXPECT_NE(error("b.bin%00.png").find("has a character that file names cannot have"), std::string::npos);
    EXPECT_NE(error(std::string(5000, 'x')).find("File name too long"), std::string::npos);
    ASSERT_EQ(::mkfifo((folder / "model/pipe").c_str(), 0600), 0);
    EXPECT_NE(error("pipe").find("is not a regular file"), std::string::npos);
    for (const std::string& uri : {std::string(5000, 'x'), std::string("pipe"), std::string("/etc/passwd")}) {
        EXPECT_EQ(error(uri).find("filesystem error"), std::string::npos);
    }
}

// A thousand buffers that are one file: it is in memory once.
TEST_F(GltfFiles, MayNameAFileManyTimes) {
    std::ofstream(folder / "model/large.bin") << std::string(std::size_t{8} << 20, '\0');
    GltfBuilder builder;
    builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    builder.setPrimitive({{"attributes", {{"POSITION", 0}}}});
    builder.json["buffers"] = Json::array();
    for (int i = 0; i < 1000; ++i) {
        builder.json["buffers"].push_back({{"byteLength", 36}, {"uri", i % 2 == 0 ? "large.bin" : "./large.bin"}});
    }
    const std::string text = builder.json.dump();
    const Scene scene =
        loadGltf(folder / "model/a.gltf", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    EXPECT_EQ(scene.inputs.size(), 1u);
}

} // namespace
