// glTF: structure, geometry, and what is refused.
#include "tests/support/gltf_builder.hpp"

#include <gtest/gtest.h>

#include <random>
#include <span>

using namespace nacre;
using namespace nacre::scene;
using test::GltfBuilder;
using Json = nlohmann::json;

namespace {

std::string errorOf(std::span<const std::uint8_t> bytes) {
    try {
        loadGltf("test.glb", bytes);
    } catch (const SceneError& failure) {
        return failure.what();
    }
    return "";
}

void expectVec3(const glm::vec3& actual, const glm::vec3& expected) {
    EXPECT_NEAR(glm::distance(actual, expected), 0, 1e-5) << actual.x << " " << actual.y << " " << actual.z;
}

TEST(Gltf, ComputesFlatNormals) {
    GltfBuilder builder;
    const auto positions = builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
    builder.setPrimitive(
        {{"attributes", {{"POSITION", positions}}}, {"indices", builder.addIndices({0, 1, 2, 0, 2, 3})}});
    const Scene scene = builder.load();
    EXPECT_EQ(triangleCount(scene), 2u);
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.vertices.size(), 6u); // the two faces share an edge, but no normal
    for (std::size_t corner = 0; corner < 6; ++corner) {
        expectVec3(mesh.vertices[mesh.indices[corner]].normal, corner < 3 ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0));
    }
}

TEST(Gltf, PlacesNodesInTheirHierarchy) {
    GltfBuilder builder;
    builder.setSquare();
    const double half = std::sqrt(0.5);
    builder.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                             {{"children", {2}}, {"rotation", {0, 0, half, half}}}, // a quarter turn about z
                             {{"mesh", 0}, {"scale", {2, 3, 1}}}};
    const Bounds box = bounds(builder.load());
    expectVec3(box.low, {7, 0, 0});
    expectVec3(box.high, {10, 2, 0});
}

// Floats have steps of centimetres and metres there.
TEST(Gltf, MovesWhatIsFarToTheOrigin) {
    for (const double distance : {5e5, 6.378e6}) {
        GltfBuilder builder;
        builder.setSquare();
        const double x = distance + 0.125;
        builder.json["nodes"] = {{{"children", {1, 2, 3}}, {"translation", {x, 0, -distance}}},
                                 {{"mesh", 0}, {"translation", {0.01, 0, 0}}},
                                 {{"mesh", 0}, {"translation", {-0.01, 0, 0}}},
                                 {{"camera", 0}, {"translation", {0, 0, 5}}}};
        builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
        const Scene scene = builder.load();
        EXPECT_EQ(scene.origin, glm::dvec3(x, 0, -distance));
        expectVec3(bounds(scene).low, {-0.01f, 0, 0});
        expectVec3(bounds(scene).high, {1.01f, 1, 0});
        expectVec3(scene.cameras.at(0).position, {0, 0, 5});
    }
    GltfBuilder near;
    near.setSquare();
    near.json["nodes"][0]["translation"] = {900, 0, 0};
    EXPECT_EQ(near.load().origin, glm::dvec3(0));
}

TEST(Gltf, UnrollsStripsAndFans) {
    for (const int mode : {5, 6}) {
        GltfBuilder builder;
        const std::vector<float> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
        const std::vector<float> fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0};
        const auto positions = builder.addFloats(mode == 5 ? strip : fan, "VEC3", 3);
        builder.setPrimitive({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
        const Scene scene = builder.load();
        EXPECT_EQ(triangleCount(scene), 3u);
        for (const Vertex& vertex : scene.meshes[0].vertices) {
            expectVec3(vertex.normal, {0, 0, 1}); // every triangle is counter-clockwise
        }
    }
}

TEST(Gltf, SaysWhenOnlyPointsOrLinesAreThere) {
    GltfBuilder builder;
    builder.setSquare()["mode"] = 1;
    EXPECT_EQ(builder.error(), "test.glb: has points or lines, but no triangles");
}

TEST(Gltf, AppliesSparseAccessors) {
    GltfBuilder builder;
    builder.setSquare();
    const auto indices = builder.addView(std::vector<std::uint8_t>{2});
    const auto values = builder.addView(std::vector<float>{5, 6, 7});
    builder.json["accessors"][0]["sparse"] = {{"count", 1},
                                              {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                              {"values", {{"bufferView", values}}}};
    expectVec3(bounds(builder.load()).high, {5, 6, 7});
    builder.json["accessors"][0].erase("bufferView"); // zeros but for the sparse element
    expectVec3(bounds(builder.load()).low, {0, 0, 0});
    builder.json["accessors"][0]["count"] = 4000000000u;
    EXPECT_NE(builder.error().find("accessors[0].count is 4000000000"), std::string::npos) << builder.error();
    builder.json["accessors"][0]["count"] = 2;
    EXPECT_NE(builder.error().find("accessors[0].sparse.indices[0] is 2, must be below 2"), std::string::npos)
        << builder.error();
}

TEST(Gltf, MakesTangentsOnBothSidesOfAMirror) {
    for (const bool mirrored : {false, true}) {
        GltfBuilder builder;
        Json& primitive = builder.setSquare();
        if (mirrored) {
            primitive["attributes"]["TEXCOORD_0"] = builder.addFloats({1, 1, 0, 1, 0, 0, 1, 0}, "VEC2", 2);
        }
        primitive["material"] = 0;
        builder.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
        builder.json["textures"] = {{{"source", 0}}};
        builder.json["images"] = {
            {{"uri", "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR"
                     "42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg=="}}};
        const Scene scene = builder.load();
        ASSERT_EQ(scene.textures.size(), 1u);
        EXPECT_EQ(scene.textures[0].width, 1u);
        EXPECT_FALSE(scene.textures[0].srgb);
        for (const Vertex& vertex : scene.meshes[0].vertices) {
            expectVec3(glm::vec3(vertex.tangent), {mirrored ? -1 : 1, 0, 0});
            // The bitangent points up in the image: v grows downwards, and the image is upright in both squares.
            expectVec3(glm::cross(vertex.normal, glm::vec3(vertex.tangent)) * vertex.tangent.w, {0, 1, 0});
        }
    }
}

TEST(Gltf, PosesSkinsAndAppliesMorphTargets) {
    GltfBuilder builder;
    Json& primitive = builder.setSquare();
    primitive["attributes"]["JOINTS_0"] =
        builder.addAccessor(builder.addView(std::vector<std::uint8_t>(16, 0)), 5121, 4, "VEC4");
    primitive["attributes"]["WEIGHTS_0"] =
        builder.addFloats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    primitive["targets"] = {{{"POSITION", builder.addFloats({0, 0, 4, 0, 0, 4, 0, 0, 4, 0, 0, 4}, "VEC3", 3)}}};
    builder.json["meshes"][0]["weights"] = {0.5};
    builder.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"children", {1}}}, {{"translation", {0, 3, 0}}}};
    builder.json["skins"] = {{{"joints", {1}}}};
    const Bounds box = bounds(builder.load());
    expectVec3(box.low, {0, 3, 2});
    expectVec3(box.high, {1, 4, 2});
}

TEST(Gltf, ReadsCamerasAndLights) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"},
                                                                    {"intensity", 20},
                                                                    {"color", {1, 0.5, 0}},
                                                                    {"range", 9},
                                                                    {"spot", {{"outerConeAngle", 0.5}}}},
                                                                   {{"type", "directional"}, {"intensity", 3}}};
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}}};
    builder.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2, 3}}},
                             {{"camera", 0}, {"translation", {0, 0, 5}}},
                             {{"camera", 1}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
                             {{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}}};
    const Scene scene = builder.load();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_FLOAT_EQ(scene.cameras[0].verticalFieldOfView, 0.7f);
    expectVec3(scene.cameras[0].position, {0, 0, 5});
    expectVec3(scene.cameras[0].target, {0, 0, 4});
    EXPECT_EQ(scene.cameras[1].projection, ProjectionKind::Orthographic);
    EXPECT_FLOAT_EQ(scene.cameras[1].orthographicHeight, 6);
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::Spot);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 20);
    EXPECT_FLOAT_EQ(scene.lights[0].range, 9);
    EXPECT_FLOAT_EQ(scene.lights[0].outerConeAngle, 0.5f);
    expectVec3(scene.lights[1].direction, {0, 0, -1});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"][1]["intensity"] = -3;
    EXPECT_EQ(builder.error(),
              "test.glb: extensions.KHR_lights_punctual.lights[1].intensity is -3, must be 0 to 1e+12");
}

TEST(Gltf, LeavesOutACameraThatLooksNowhere) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}}};
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    builder.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2, 3}}},
                             {{"camera", 0}, {"scale", {1, 0, 1}}},
                             {{"camera", 0}, {"scale", {1e-30, 1e-30, 1e-30}}}, // looks as any other
                             {{"scale", {1, 1, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    const Scene scene = builder.load();
    ASSERT_EQ(scene.cameras.size(), 1u);
    expectVec3(scene.cameras[0].target, {0, 0, -1});
    expectVec3(scene.cameras[0].up, {0, 1, 0});
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_EQ(scene.notes[0], "test.glb: nodes[1] has a scale of 0: its camera looks nowhere and is left out");
    expectVec3(scene.lights.at(0).direction, {0, 0, -1});
}

struct Damage {
    const char* pointer;
    Json value;
    const char* sentence;
};

TEST(Gltf, NamesTheFieldThatIsWrong) {
    const Damage damages[]{
        {"/accessors/0/count", 5, "accessors[0] reaches from byte 0 over 60 bytes, but there are only 48"},
        {"/accessors/0/bufferView", 7, "accessors[0].bufferView is 7, but there are only 3"},
        {"/accessors/0/componentType", 5124, "accessors[0].componentType is 5124"},
        {"/accessors/0/type", "VEC2", "POSITION has 2 components, must have 3"},
        {"/accessors/1/count", 3, "TEXCOORD_0 has 3 elements, but POSITION has 4"},
        {"/accessors/2/componentType", 5126, "must be of unsigned integers"},
        {"/bufferViews/0/byteLength", 100000, "bufferViews[0] reaches from byte 0 over 100000 bytes"},
        {"/bufferViews/0/buffer", 3, "bufferViews[0].buffer is 3, but there are only 1"},
        {"/nodes/0/mesh", 2, "nodes[0].mesh is 2, but there are only 1"},
        {"/nodes/0/children", {0}, "nodes[0] is reached twice: nodes must form a tree"},
        {"/nodes/0/scale", {1, 2}, "nodes[0].scale must be an array of 3 numbers"},
        {"/nodes/0/translation", {1e30, 0, 0}, "nodes[0] has a transform that is not finite"},
        {"/meshes/0/primitives/0/material", 4, "material is 4, but there are only 0"},
        {"/scene", "first", "test.glb: scene is \"first\", must be a whole number, 0 or more"},
        {"/scenes/0/nodes", 0, "scenes[0].nodes is 0, must be an array of whole numbers, 0 or more"},
        {"/nodes/0/mesh", "first", "nodes[0].mesh is \"first\", must be a whole number, 0 or more"},
        {"/nodes/0/skin", -2, "nodes[0].skin is -2, must be a whole number, 0 or more"},
        {"/nodes/0/rotation", {0, 0, 0, "w"}, "nodes[0].rotation is [0,0,0,\"w\"], must be an array of numbers"},
        {"/meshes/0/primitives/0/mode", 4.5, "meshes[0].primitives[0].mode is 4.5, must be a whole number, 0 or more"},
        {"/materials/0/pbrMetallicRoughness/metallicFactor", "high", "metallicFactor is \"high\", must be a number"},
        {"/materials/0/pbrMetallicRoughness", 1, "materials[0].pbrMetallicRoughness is 1, must be an object"},
        {"/materials/0/doubleSided", 1, "materials[0].doubleSided is 1, must be true or false"},
        {"/materials/0/alphaMode", 1, "materials[0].alphaMode is 1, must be a string"},
        {"/accessors/0/byteOffset", "12", "accessors[0].byteOffset is \"12\", must be a whole number, 0 or more"},
        {"/extensions/KHR_lights_punctual/lights",
         {{{"type", "point"}, {"intensity", "bright"}}},
         "extensions.KHR_lights_punctual.lights[0].intensity is \"bright\", must be a number"},
        {"/meshes/0/primitives/0/mode", 9, "meshes[0].primitives[0].mode is 9, must be 0 to 6"},
        {"/extensionsRequired", {"KHR_texture_basisu"}, "requires the extension \"KHR_texture_basisu\""},
        {"/asset/version", "3.0", "asset.version is \"3.0\", must be \"2.0\""},
        {"/buffers", {{{"uri", "missing.bin"}}}, "buffers[0].uri \"missing.bin\" does not exist"},
    };
    for (const Damage& damage : damages) {
        GltfBuilder builder;
        builder.setSquare();
        builder.json[Json::json_pointer(damage.pointer)] = damage.value;
        EXPECT_NE(builder.error().find(damage.sentence), std::string::npos)
            << damage.pointer << ": " << builder.error();
        EXPECT_TRUE(builder.error().starts_with("test.glb: ")) << builder.error();
    }
}

TEST(Gltf, RefusesBadIndicesAndPositions) {
    GltfBuilder builder;
    builder.setSquare()["indices"] = builder.addIndices({0, 1, 4});
    EXPECT_NE(builder.error().find("has the vertex index 4, but only 4 vertices"), std::string::npos);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
        GltfBuilder other;
        other.setSquare()["attributes"]["POSITION"] =
            other.addFloats({0, 0, 0, 1, 0, 0, bad, 1, 0, 0, 1, 0}, "VEC3", 3);
        EXPECT_NE(other.error().find("the position of vertex 2 is"), std::string::npos) << other.error();
    }
}

TEST(Gltf, SaysWhereATextureIsMissing) {
    GltfBuilder builder;
    builder.setSquare()["material"] = 0;
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    EXPECT_NE(
        builder.error().find("materials[0].pbrMetallicRoughness.baseColorTexture.index is 0, but there are only 0"),
        std::string::npos)
        << builder.error();
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"uri", "absent.png"}}};
    EXPECT_EQ(builder.error(), "test.glb: images[0].uri \"absent.png\" does not exist");
    builder.json["images"] = {{{"uri", "data:image/gif;base64,R0lGODlhAQABAAAAACw="}}};
    EXPECT_EQ(builder.load().notes,
              std::vector<std::string>{"test.glb: images[0]: is a GIF image, which is not read here; it is left out"});
    builder.json["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
    EXPECT_NE(builder.error().find("images[0]: is not a PNG"), std::string::npos) << builder.error();
}

TEST(Gltf, SurvivesTruncationAtEveryLength) {
    GltfBuilder builder;
    builder.setSquare();
    const std::vector<std::uint8_t> whole = builder.glb();
    EXPECT_EQ(errorOf(whole), "");
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_TRUE(errorOf(std::span(whole).first(size)).starts_with("test.glb: ")) << size;
    }
    EXPECT_NE(errorOf(std::span(whole).first(whole.size() - 1)).find("is truncated"), std::string::npos);
}

/// Loads, or is refused with a sentence; anything else ends the program.
TEST(Gltf, SurvivesChangedBytes) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["nodes"][0]["rotation"] = {0, 0, 0, 1};
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0.25, 1}}}},
                                  {"extensions", {{"KHR_materials_volume", {{"thicknessFactor", 0.01}}}}}}};
    const std::vector<std::uint8_t> whole = builder.glb();
    std::mt19937 random(1);
    std::size_t refused = 0;
    for (int round = 0; round < 4000; ++round) {
        std::vector<std::uint8_t> bytes = whole;
        for (unsigned change = 0; change <= random() % 3; ++change) {
            constexpr std::string_view likely = "0123456789-.e\"[]{},:tfn";
            bytes[20 + random() % (bytes.size() - 20)] = static_cast<std::uint8_t>(likely[random() % likely.size()]);
        }
        refused += errorOf(bytes).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 1000u);
}

TEST(Gltf, RefusesDeepNesting) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["extensions"]["deep"] = Json::parse(std::string(200, '[') + std::string(200, ']'));
    EXPECT_EQ(builder.error(), "test.glb: its JSON is nested more than 64 deep");
}

} // namespace
