// Valid glTF that few exporters write: data URIs and names in every spelling, sparse indices, channels and instances
// without what is usual.
#include "image/image.hpp"
#include "image/image_file.hpp"
#include "scene/import.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

using namespace nacre::scene;
using nacre::test::GltfBuilder;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string redPixel =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==";

/// A square whose texture is the image that the URI names.
GltfBuilder squareWith(const std::string& uri) {
    GltfBuilder builder;
    builder.setSquare()["material"] = 0;
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    builder.json["images"] = {{{"uri", uri}}};
    builder.json["textures"] = {{{"source", 0}}};
    return builder;
}

std::vector<std::uint8_t> decoded(const std::string& base64) {
    const Scene scene = squareWith("data:image/png;base64," + base64).load();
    return scene.textures.at(0).pixels;
}

std::string percentEncoded(const std::vector<std::uint8_t>& bytes) {
    constexpr const char* digits = "0123456789ABCDEF";
    std::string text;
    for (const std::uint8_t byte : bytes) {
        text += {'%', digits[byte >> 4], digits[byte & 15]};
    }
    return text;
}

TEST(GltfVariants, DataUrisHaveAnyMediaTypeCaseAndEncoding) {
    const std::vector<std::uint8_t> red = decoded(redPixel);
    std::string escaped = redPixel;
    for (std::size_t place = escaped.find('='); place != std::string::npos; place = escaped.find('=', place)) {
        escaped.replace(place, 1, "%3D");
    }
    for (const std::string& uri :
         {"data:;base64," + redPixel, "DATA:image/png;base64," + redPixel, "data:image/png;BASE64," + redPixel,
          "data:application/x-odd;charset=utf-8;base64," + redPixel, "data:image/png;base64," + escaped}) {
        EXPECT_EQ(squareWith(uri).load().textures.at(0).pixels, red) << uri;
    }
    EXPECT_NE(squareWith("data:image/png;base64").error().find("without a comma"), std::string::npos);
    EXPECT_NE(squareWith("data:image/png;base64,*").error(), "");
}

TEST(GltfVariants, DataUrisWithoutBase64ArePercentEncoded) {
    GltfBuilder builder;
    builder.setSquare();
    const Bounds expected = bounds(builder.load());
    Json document = builder.json;
    document["buffers"] = {{{"byteLength", builder.binary.size()},
                            {"uri", "data:application/octet-stream," + percentEncoded(builder.binary)}}};
    const std::string text = document.dump();
    const Scene scene = loadGltf("test.gltf", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    EXPECT_EQ(bounds(scene).high, expected.high);
}

class NamedImages : public testing::Test {
protected:
    /// What is loaded of a model beside a red picture of that name, which the model calls so.
    std::string errorOf(const std::string& name, const std::string& uri) const {
        nacre::Image red = nacre::makeImage(1, 1, {"R", "G", "B"}, nacre::Encoding::Srgb);
        red.values[0] = 1;
        nacre::writePng(folder / "red.png", red);
        fs::rename(folder / "red.png", folder / name);
        const std::vector<std::uint8_t> glb = squareWith(uri).glb();
        std::ofstream(folder / "m.glb", std::ios::binary)
            .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
        try {
            const Scene scene = load(folder / "m.glb");
            return scene.textures.at(0).pixels == std::vector<std::uint8_t>{255, 0, 0, 255} ? "" : "another picture";
        } catch (const SceneError& error) {
            return error.what();
        }
    }
    const nacre::tests::TemporaryFolder temporary;
    const fs::path& folder = temporary.path;
};

TEST_F(NamedImages, MayBeWrittenAsTheyAreOrEncoded) {
    const std::pair<const char*, const char*> names[] = {
        {"a b.png", "a%20b.png"},       {"a b.png", "a b.png"},          {"rö.png", "r%C3%B6.png"},
        {"rö.png", "rö.png"},           {"100%20.png", "100%20.png"},    {"100%20.png", "100%2520.png"},
        {"q?x#y.png", "q%3Fx%23y.png"}, {"r+d.png", "./none/../r+d.png"}};
    for (const auto& [name, uri] : names) {
        EXPECT_EQ(errorOf(name, uri), "") << name << ' ' << uri;
    }
    EXPECT_NE(errorOf("a.png", "none/../../a.png"), "");
}

TEST(GltfVariants, IndicesMayBeSparse) {
    GltfBuilder builder;
    Json& primitive = builder.setSquare();
    const auto places = builder.addView(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 2, 4, 5});
    builder.json["bufferViews"][places]["byteLength"] = 8;
    const auto values = builder.addView(std::vector<std::uint16_t>{1, 2, 2, 3});
    builder.json["accessors"].push_back(
        {{"componentType", 5123},
         {"bufferView", builder.addView(std::vector<std::uint16_t>(6))},
         {"count", 6},
         {"type", "SCALAR"},
         {"sparse",
          {{"count", 4},
           {"indices", {{"bufferView", places}, {"byteOffset", 4}, {"componentType", 5121}}},
           {"values", {{"bufferView", values}}}}}});
    primitive["indices"] = builder.json["accessors"].size() - 1;
    EXPECT_EQ(builder.load().meshes.at(0).indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    builder.json["accessors"].back()["sparse"]["indices"]["componentType"] = 5123;
    EXPECT_NE(builder.error().find("sparse.indices"), std::string::npos) << builder.error();
}

TEST(GltfVariants, ChannelsWithoutANodeAreNoted) {
    GltfBuilder builder;
    builder.setSquare();
    const auto times = builder.addFloats({0, 1}, "SCALAR", 1);
    const auto colors = builder.addFloats({1, 0, 0, 1, 0, 1, 0, 1}, "VEC4", 4);
    builder.json["animations"] = {{{"samplers", {{{"input", times}, {"output", colors}}}},
                                   {"channels", {{{"sampler", 0}, {"target", {{"path", "pointer"}}}}}}}};
    const std::vector<std::uint8_t> glb = builder.glb();
    EXPECT_EQ(loadGltf("test.glb", glb).notes, std::vector<std::string>{});
    EXPECT_EQ(loadGltf("test.glb", glb, 0.5).notes,
              std::vector<std::string>{"test.glb: 1 channels of its animation move something that is not read"});
}

TEST(GltfVariants, InstancesMayHaveOnlyAttributesOfTheirOwn) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"_ID", builder.addFloats({7, 8, 9}, "SCALAR", 1)}};
    EXPECT_EQ(builder.load().instances.size(), 3u);
}

TEST(GltfVariants, GlassIsNoted) {
    GltfBuilder builder;
    builder.setSquare()["material"] = 0;
    Json extensions{{"KHR_materials_transmission", {{"transmissionFactor", 0.5}}}};
    builder.json["materials"] = {{{"extensions", extensions}}};
    EXPECT_EQ(builder.load().notes,
              std::vector<std::string>{"test.glb: materials[0].extensions.KHR_materials_transmission is not drawn"});
    builder.json["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0;
    EXPECT_TRUE(builder.load().notes.empty());
}

} // namespace
