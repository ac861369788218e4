// What a glTF file means: colours of vertices, samplers, emission, copies of a node, and notes about what is left out.
#include "scene/blending.hpp"
#include "tests/support/gltf_builder.hpp"

#include <gtest/gtest.h>

using namespace nacre;
using namespace nacre::scene;
using test::GltfBuilder;
using Json = nlohmann::json;

namespace {

/// A PNG of one red pixel.
const std::string redPixel =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==";

bool hasNote(const Scene& scene, const std::string& part) {
    return std::ranges::any_of(scene.notes,
                               [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

/// A square of one material, and one texture of a red pixel.
GltfBuilder texturedSquare(const Json& material) {
    GltfBuilder builder;
    builder.setSquare()["material"] = 0;
    builder.json["materials"] = Json::array({material});
    builder.json["images"] = Json::array({{{"uri", redPixel}}});
    builder.json["textures"] = Json::array({{{"source", 0}}});
    return builder;
}

TEST(GltfMeaning, VertexColorsMultiplyTheBaseColor) {
    GltfBuilder builder;
    const auto colors = builder.addFloats({1, 0, 0, 0.25f, 0.5f, 0, 1, 1, 0, 0, 2, 1, -1, 0, 0, 1}, "VEC4", 4);
    builder.setSquare()["attributes"]["COLOR_0"] = colors;
    const Scene scene = builder.load();
    const std::vector<Vertex>& vertices = scene.meshes.at(0).vertices;
    const auto corner = [&](float x, float y) {
        return std::ranges::find_if(vertices, [&](const Vertex& v) { return v.position == glm::vec3(x, y, 0); })->color;
    };
    using Color = glm::vec<4, std::uint16_t>;
    EXPECT_EQ(corner(0, 0), Color(65535, 0, 0, 16384));
    EXPECT_EQ(corner(1, 0), Color(32768, 0, 65535, 65535));
    EXPECT_EQ(corner(1, 1), Color(0, 0, 65535, 65535)); // cut off at 1
    EXPECT_EQ(corner(0, 1), Color(0, 0, 0, 65535));     // and at 0
}

TEST(GltfMeaning, VertexColorsOfBytesWithoutAlpha) {
    GltfBuilder builder;
    const std::vector<std::uint8_t> bytes{255, 0, 0, 0, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const auto view = builder.addView(bytes);
    builder.setSquare();
    const auto accessor = builder.addAccessor(view, 5121, 4, "VEC3");
    builder.json["bufferViews"][view]["byteStride"] = 4;
    builder.json["accessors"][accessor]["normalized"] = true;
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = accessor;
    const Scene scene = builder.load();
    for (const Vertex& vertex : scene.meshes.at(0).vertices) {
        EXPECT_EQ(vertex.color.w, 65535);
        EXPECT_EQ(vertex.color.x, vertex.position == glm::vec3(0)         ? 65535
                                  : vertex.position == glm::vec3(1, 0, 0) ? 13107
                                                                          : 0);
    }
}

TEST(GltfMeaning, VertexColorsOfTwoNumbersAreRefused) {
    GltfBuilder builder;
    const auto colors = builder.addFloats(std::vector<float>(8), "VEC2", 2);
    builder.setSquare()["attributes"]["COLOR_0"] = colors;
    EXPECT_NE(builder.error().find("attributes.COLOR_0 has 2 components, must have 3 or 4"), std::string::npos)
        << builder.error();
}

TEST(GltfMeaning, SamplersSayHowTexturesWrap) {
    GltfBuilder builder = texturedSquare(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}, {"normalTexture", {{"index", 1}}}});
    builder.json["samplers"] = Json::array({{{"wrapS", 33648}, {"wrapT", 33071}, {"magFilter", 9728}}});
    builder.json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}, {{"source", 0}}});
    const Scene scene = builder.load();
    const Texture& color = scene.textures.at(scene.surfaces.at(0).baseColorTexture);
    EXPECT_EQ(color.wrapU, Wrap::Mirror);
    EXPECT_EQ(color.wrapV, Wrap::Clamp);
    EXPECT_TRUE(color.nearest);
    const Texture& normal = scene.textures.at(scene.surfaces.at(0).normalTexture);
    EXPECT_EQ(normal.wrapU, Wrap::Repeat);
    EXPECT_EQ(normal.wrapV, Wrap::Repeat);
    EXPECT_FALSE(normal.nearest);
    builder.json["samplers"][0]["wrapT"] = 7;
    EXPECT_NE(builder.error().find("samplers[0].wrapT is 7, must be 10497, 33648 or 33071"), std::string::npos)
        << builder.error();
}

TEST(GltfMeaning, EmissionHasATexture) {
    const Scene scene = texturedSquare({{"emissiveFactor", {1, 0.5, 1}}, {"emissiveTexture", {{"index", 0}}}}).load();
    const Surface& surface = scene.surfaces.at(0);
    EXPECT_EQ(surface.emission, glm::vec3(1, 0.5f, 1));
    ASSERT_NE(surface.emissionTexture, none);
    EXPECT_TRUE(scene.textures.at(surface.emissionTexture).srgb);
}

TEST(GltfMeaning, ATextureWithoutAnImageIsLeftOutWithANote) {
    GltfBuilder builder = texturedSquare({{"emissiveFactor", {1, 1, 1}},
                                          {"emissiveTexture", {{"index", 0}}},
                                          {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.json["textures"] = Json::array({{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}});
    builder.json["extensionsUsed"] = {"KHR_texture_basisu"};
    const Scene scene = builder.load();
    EXPECT_EQ(scene.surfaces.at(0).baseColorTexture, none);
    EXPECT_EQ(scene.surfaces.at(0).emission, glm::vec3(0)); // which its texture might have left dark
    EXPECT_TRUE(hasNote(scene, "textures[0] has no image but for KHR_texture_basisu, which is not read"));
    EXPECT_TRUE(hasNote(scene, "uses the extension \"KHR_texture_basisu\", which is not read"));
    builder.json["textures"] = Json::array({Json::object()});
    EXPECT_TRUE(hasNote(builder.load(), "textures[0] has no image; it is left out"));
    builder.json["extensionsRequired"] = {"KHR_texture_basisu"};
    EXPECT_NE(builder.error().find("requires the extension \"KHR_texture_basisu\""), std::string::npos);
}

TEST(GltfMeaning, ALookThatIsNotDrawnIsNoted) {
    GltfBuilder builder = texturedSquare({{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}});
    builder.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_ior"};
    const Scene scene = builder.load();
    EXPECT_TRUE(hasNote(scene, "uses the extension \"KHR_materials_clearcoat\", which is not drawn"));
    EXPECT_EQ(scene.notes.size(), 1u);
}

TEST(GltfMeaning, WebpTakesTheExtensionsImage) {
    GltfBuilder builder = texturedSquare({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    // One pixel, lossless.
    builder.json["images"].push_back(
        {{"uri", "data:image/webp;base64,UklGRhwAAABXRUJQVlA4TA8AAAAvAAAAAAcQ/Y/+ByKi/wEA"}});
    builder.json["textures"] = Json::array({{{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}});
    builder.json["extensionsRequired"] = {"EXT_texture_webp"};
    const Scene scene = builder.load();
    const Texture& texture = scene.textures.at(scene.surfaces.at(0).baseColorTexture);
    EXPECT_EQ(texture.name, "images[1]");
    EXPECT_EQ(texture.width, 1u);
}

Scene settled(const GltfBuilder& builder) {
    GltfBuilder copy = builder;
    Scene scene = copy.load();
    settleBlending(scene, "test.glb");
    return scene;
}

/// What becomes of a blended material with a base colour of this alpha.
AlphaMode modeOf(double alpha, const Json& extensions = Json::object()) {
    const Scene scene = settled(texturedSquare({{"alphaMode", "BLEND"},
                                                {"extensions", extensions},
                                                {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}}));
    EXPECT_EQ(hasNote(scene, "scatters light and is not blended"), scene.surfaces.at(0).material != none);
    return scene.surfaces.at(0).alphaMode;
}

TEST(GltfMeaning, WhatIsSeeThroughIsBlendedUnlessItScatters) {
    EXPECT_EQ(modeOf(0.05), AlphaMode::Blend);
    EXPECT_EQ(modeOf(1), AlphaMode::Opaque);
    const Json leaf = {{"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.5}}}};
    EXPECT_EQ(modeOf(0.75, leaf), AlphaMode::Mask);
}

TEST(GltfMeaning, AlphaOfVerticesAndTexturesIsBlended) {
    GltfBuilder builder = texturedSquare({{"alphaMode", "BLEND"}});
    const auto colors = builder.addFloats({1, 1, 1, 1, 1, 1, 1, 0.5f, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC4", 4);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
    EXPECT_EQ(settled(builder).surfaces.at(0).alphaMode, AlphaMode::Blend);
    builder =
        texturedSquare({{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.json["images"][0]["uri"] =
        "data:image/png;base64,"
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP4z8DwHwAFAAH/VscvDQAAAABJRU5ErkJggg==";
    EXPECT_EQ(settled(builder).surfaces.at(0).alphaMode, AlphaMode::Opaque);
    // The same, with half the alpha.
    builder.json["images"][0]["uri"] =
        "data:image/png;base64,"
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP4z8DQAAAEgQGA8wvcoAAAAABJRU5ErkJggg==";
    EXPECT_EQ(settled(builder).surfaces.at(0).alphaMode, AlphaMode::Blend);
}

TEST(GltfMeaning, EveryTextureKeepsItsTransformAndItsSet) {
    const auto tiled = [](int texCoord, double scale) {
        return Json{{"index", 0},
                    {"texCoord", texCoord},
                    {"extensions", {{"KHR_texture_transform", {{"scale", {scale, scale}}}}}}};
    };
    GltfBuilder builder = texturedSquare({{"pbrMetallicRoughness", {{"baseColorTexture", tiled(1, 1)}}},
                                          {"normalTexture", tiled(2, 4)},
                                          {"emissiveTexture", tiled(0, 2)}});
    const auto attributes = [&]() -> Json& { return builder.json["meshes"][0]["primitives"][0]["attributes"]; };
    attributes()["TEXCOORD_1"] = builder.addFloats({1, 0, 1, 0, 1, 0, 1, 0}, "VEC2", 2);
    attributes()["TEXCOORD_2"] = builder.addFloats({2, 3, 2, 3, 2, 3, 2, 3}, "VEC2", 2);
    const Scene scene = builder.load();
    const Surface& surface = scene.surfaces.at(0);
    const Vertex& vertex = scene.meshes.at(0).vertices.at(0);
    EXPECT_EQ(vertex.uv, glm::vec2(1, 0));
    EXPECT_EQ(vertex.secondUv, glm::vec2(2, 3));
    EXPECT_FALSE(surface.baseColorUv.second);
    EXPECT_EQ(surface.baseColorUv.transform, glm::mat3(1));
    EXPECT_TRUE(surface.normalUv.second);
    EXPECT_EQ(surface.normalUv.transform[1].y, 4);
    EXPECT_EQ(surface.emissionUv.transform[0].x, 2);
    EXPECT_TRUE(hasNote(scene, "materials[0].emissiveTexture.texCoord is 0, the material's third; 2 is used"));
}

TEST(GltfMeaning, InstancingPlacesANodeManyTimes) {
    GltfBuilder builder;
    builder.setSquare();
    const auto places = builder.addFloats({-4, 0, 0, 2, 0, 0, 4, 0, 0}, "VEC3", 3);
    const auto sizes = builder.addFloats({1, 1, 1, 2, 2, 2, 1, 1, 1}, "VEC3", 3);
    const float half = std::sqrt(0.5f);
    const auto turns = builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, half, half}, "VEC4", 4);
    builder.json["nodes"][0]["translation"] = {0, 10, 0};
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", places}, {"SCALE", sizes}, {"ROTATION", turns}};
    builder.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Scene scene = builder.load();
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.meshes.size(), 1u);
    const auto corner = [&](std::size_t i) { return glm::vec3(scene.instances[i].transform * glm::vec4(1, 0, 0, 1)); };
    EXPECT_NEAR(glm::distance(corner(0), {-3, 10, 0}), 0, 1e-5f);
    EXPECT_NEAR(glm::distance(corner(1), {4, 10, 0}), 0, 1e-5f);
    EXPECT_NEAR(glm::distance(corner(2), {4, 11, 0}), 0, 1e-5f);
    builder.json["accessors"][sizes]["count"] = 2;
    EXPECT_NE(builder.error().find("EXT_mesh_gpu_instancing.attributes have 2 and 3 elements"), std::string::npos)
        << builder.error();
}

TEST(GltfMeaning, HiddenNodesHideTheirChildren) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["nodes"] =
        Json::array({{{"mesh", 0}},
                     {{"children", {2}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
                     {{"mesh", 0}, {"name", "hidden"}}});
    builder.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(builder.load().instances.size(), 1u);
    builder.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = "no";
    EXPECT_NE(builder.error().find("KHR_node_visibility.visible must be true or false"), std::string::npos)
        << builder.error();
}

/// A PNG of one pixel: 255, 188, 0 and an alpha of 51.
const std::string clearPixel =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP4v4fBGAAGaAHvALWOcAAAAABJRU5ErkJggg==";

TEST(GltfMeaning, DiffuseTransmissionHasTextures) {
    GltfBuilder builder =
        texturedSquare({{"extensions",
                         {{"KHR_materials_diffuse_transmission",
                           {{"diffuseTransmissionFactor", 0.5},
                            {"diffuseTransmissionTexture", {{"index", 0}}},
                            {"diffuseTransmissionColorFactor", {0.5, 0.5, 0.5}},
                            {"diffuseTransmissionColorTexture",
                             {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 1}}}}}}}}}}}}});
    builder.json["images"][0]["uri"] = clearPixel;
    const Scene scene = builder.load();
    EXPECT_DOUBLE_EQ(scene.materials.at(0).diffuseTransmission, 0.5);
    EXPECT_EQ(scene.materials[0].diffuseTransmissionColor, (Rgb{0.5, 0.5, 0.5}));
    const Surface& surface = scene.surfaces.at(0);
    EXPECT_EQ(scene.textures.at(surface.transmissionTexture).pixels[3], 51);
    EXPECT_FALSE(surface.transmissionSetsStrength);
    EXPECT_TRUE(scene.textures.at(surface.transmissionColorTexture).srgb);
    EXPECT_EQ(surface.transmissionUv.transform[0].x, 1);
    EXPECT_EQ(surface.transmissionColorUv.transform[0].x, 2);
    EXPECT_TRUE(scene.notes.empty());
}

// A volume that scatters lets light in by the share, and has one colour.
TEST(GltfMeaning, DiffuseTransmissionOfAVolumeHasTextures) {
    GltfBuilder builder = texturedSquare(
        {{"extensions",
          {{"KHR_materials_volume",
            {{"thicknessFactor", 0.01}, {"attenuationDistance", 0.001}, {"attenuationColor", {0.5, 0.5, 0.5}}}},
           {"KHR_materials_volume_scatter", {{"multiscatterColorFactor", {0.5, 0.5, 0.5}}}},
           {"KHR_materials_diffuse_transmission",
            {{"diffuseTransmissionFactor", 0.5},
             {"diffuseTransmissionTexture", {{"index", 0}}},
             {"diffuseTransmissionColorTexture", {{"index", 0}}}}}}}});
    builder.json["images"][0]["uri"] = clearPixel;
    const Scene scene = builder.load();
    EXPECT_DOUBLE_EQ(scene.materials.at(0).strength, 0.5);
    EXPECT_DOUBLE_EQ(scene.materials[0].translucency, 0.5);
    const Surface& surface = scene.surfaces.at(0);
    EXPECT_EQ(scene.textures.at(surface.transmissionTexture).pixels[3], 51);
    EXPECT_TRUE(surface.transmissionSetsStrength);
    EXPECT_EQ(surface.transmissionColorTexture, none);
    EXPECT_TRUE(hasNote(scene, "diffuseTransmissionColorTexture is averaged to one colour, because the volume"));
    ASSERT_EQ(scene.notes.size(), 1u);
}

} // namespace
