// glTF extensions: compression, quantisation, texture transforms, subsurface media.
#include "nacre/media.hpp"
#include "scene/gltf/gltf_medium.hpp"
#include "scene/texture.hpp"
#include "tests/support/gltf_builder.hpp"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <random>

using namespace nacre;
using namespace nacre::scene;
using test::GltfBuilder;
using Json = nlohmann::json;

namespace {

void expectVec3(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-5f) {
    EXPECT_NEAR(glm::distance(actual, expected), 0, tolerance) << actual.x << " " << actual.y << " " << actual.z;
}

/// A square whose material has these extensions.
GltfBuilder squareWith(const Json& extensions) {
    GltfBuilder builder;
    builder.setSquare()["material"] = 0;
    builder.json["materials"] = Json::array({{{"name", "test"}, {"extensions", extensions}}});
    return builder;
}

TEST(GltfExtensions, DequantiseVertices) {
    GltfBuilder builder;
    builder.setSquare();
    builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const std::vector<std::int16_t> positions{0, 0, 0, 0, 32767, 0, 0, 0, 32767, -32768, 0, 0, 0, 32767, 0, 0};
    const auto view = builder.addView(positions);
    builder.json["bufferViews"][view]["byteStride"] = 8;
    const auto accessor = builder.addAccessor(view, 5122, 4, "VEC3");
    builder.json["accessors"][accessor]["normalized"] = true;
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
    const Bounds normalized = bounds(builder.load());
    expectVec3(normalized.low, {0, -1, 0});
    expectVec3(normalized.high, {1, 1, 0});
    builder.json["accessors"][accessor]["normalized"] = false;
    expectVec3(bounds(builder.load()).low, {0, -32768, 0});
}

/// The square with positions and indices compressed, over a fallback buffer without data.
GltfBuilder meshoptSquare(bool exponential) {
    GltfBuilder builder;
    builder.setSquare();
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    std::vector<std::uint8_t> filtered(48);
    std::memcpy(filtered.data(), positions.data(), 48);
    if (exponential) {
        meshopt_encodeFilterExp(filtered.data(), 4, 12, 15, positions.data());
    }
    std::vector<std::uint8_t> vertices(meshopt_encodeVertexBufferBound(4, 12));
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), filtered.data(), 4, 12));
    std::vector<std::uint8_t> triangles(meshopt_encodeIndexBufferBound(6, 4));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), 6));
    const auto compress = [&](std::size_t view, const std::vector<std::uint8_t>& data, std::size_t count,
                              std::size_t stride, const char* mode) {
        const auto source = builder.json["bufferViews"][builder.addView(data)];
        builder.json["bufferViews"][view] = {{"buffer", 1},
                                             {"byteLength", count * stride},
                                             {"extensions",
                                              {{"EXT_meshopt_compression",
                                                {{"buffer", 0},
                                                 {"byteOffset", source["byteOffset"]},
                                                 {"byteLength", data.size()},
                                                 {"byteStride", stride},
                                                 {"count", count},
                                                 {"mode", mode}}}}}};
    };
    compress(0, vertices, 4, 12, "ATTRIBUTES");
    compress(2, triangles, 6, 4, "TRIANGLES");
    if (exponential) {
        builder.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["filter"] = "EXPONENTIAL";
    }
    builder.json["accessors"][2]["componentType"] = 5125;
    builder.json["buffers"] = {
        Json::object(), {{"byteLength", 72}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    builder.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    return builder;
}

TEST(GltfExtensions, DecompressMeshopt) {
    for (const bool exponential : {false, true}) {
        const Scene scene = meshoptSquare(exponential).load();
        EXPECT_EQ(triangleCount(scene), 2u);
        expectVec3(bounds(scene).low, {0, 0, 0}, 1e-3f);
        expectVec3(bounds(scene).high, {1, 1, 0}, 1e-3f);
    }
}

TEST(GltfExtensions, RefuseDamagedMeshopt) {
    for (const auto& [key, value] : std::initializer_list<std::pair<const char*, Json>>{{"count", 4000000000u},
                                                                                        {"byteStride", 0},
                                                                                        {"byteStride", 6},
                                                                                        {"byteLength", 3},
                                                                                        {"byteLength", 1000000},
                                                                                        {"buffer", 5},
                                                                                        {"mode", "ELSE"},
                                                                                        {"filter", "QUATERNION"},
                                                                                        {"count", -1},
                                                                                        {"byteOffset", 1.5}}) {
        GltfBuilder builder = meshoptSquare(false);
        builder.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
        EXPECT_NE(builder.error().find("bufferViews[0].extensions.EXT_meshopt_compression"), std::string::npos)
            << key << ": " << builder.error();
    }
    std::mt19937 random(2);
    const GltfBuilder whole = meshoptSquare(false);
    for (int round = 0; round < 2000; ++round) {
        GltfBuilder builder = whole;
        builder.binary[random() % builder.binary.size()] = static_cast<std::uint8_t>(random());
        builder.error();
    }
}

/// A sphere-like strip of triangles, compressed.
GltfBuilder dracoMesh(std::size_t faces) {
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(static_cast<int>(faces));
    const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::size_t face = 0; face < faces; ++face) {
        const auto point = [&](std::size_t i) {
            const float angle = 6.2831853f * static_cast<float>(i % faces) / static_cast<float>(faces);
            return std::array{std::cos(angle), std::sin(angle), static_cast<float>(i % 2)};
        };
        const auto a = point(face), b = point(face + 1), c = point(face + 2);
        soup.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(face)), a.data(), b.data(),
                                       c.data());
    }
    const auto mesh = soup.Finalize();
    draco::EncoderBuffer encoded;
    EXPECT_TRUE(draco::Encoder().EncodeMeshToBuffer(*mesh, &encoded).ok());
    GltfBuilder builder;
    const auto view = builder.addView(std::vector<std::uint8_t>(encoded.data(), encoded.data() + encoded.size()));
    builder.json["accessors"] = {{{"componentType", 5126}, {"count", mesh->num_points()}, {"type", "VEC3"}},
                                 {{"componentType", 5125}, {"count", faces * 3}, {"type", "SCALAR"}}};
    const auto id = mesh->attribute(position)->unique_id();
    builder.setPrimitive(
        {{"attributes", {{"POSITION", 0}}},
         {"indices", 1},
         {"extensions", {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", {{"POSITION", id}}}}}}}});
    return builder;
}

TEST(GltfExtensions, DecompressDraco) {
    const Scene scene = dracoMesh(40).load();
    EXPECT_EQ(triangleCount(scene), 40u);
    expectVec3(bounds(scene).low, {-1, -1, 0}, 1e-3f);
    GltfBuilder wrong = dracoMesh(40);
    Json& extension = wrong.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
    extension["attributes"]["POSITION"] = 9;
    EXPECT_NE(wrong.error().find("attributes.POSITION is 9, which the compressed data do not have"), std::string::npos)
        << wrong.error();
}

/// A compressed triangle whose first corner is white and whose others are dark: an accessor of normalized bytes.
template <typename Component>
GltfBuilder dracoColors(draco::DataType type, bool normalizedInDraco, Component high, Component low) {
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(1);
    const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int color = soup.AddAttribute(draco::GeometryAttribute::COLOR, 3, type, normalizedInDraco);
    const std::array<std::array<float, 3>, 3> points{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    const std::array<Component, 3> light{high, high, high}, dark{low, low, low};
    soup.SetAttributeValuesForFace(position, draco::FaceIndex(0), points[0].data(), points[1].data(), points[2].data());
    soup.SetAttributeValuesForFace(color, draco::FaceIndex(0), light.data(), dark.data(), dark.data());
    const auto mesh = soup.Finalize();
    draco::EncoderBuffer encoded;
    EXPECT_TRUE(draco::Encoder().EncodeMeshToBuffer(*mesh, &encoded).ok());
    GltfBuilder builder;
    const auto view = builder.addView(std::vector<std::uint8_t>(encoded.data(), encoded.data() + encoded.size()));
    builder.json["accessors"] = {{{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
                                 {{"componentType", 5121}, {"count", 3}, {"type", "VEC3"}, {"normalized", true}}};
    const Json ids = {{"POSITION", mesh->attribute(position)->unique_id()},
                      {"COLOR_0", mesh->attribute(color)->unique_id()}};
    builder.setPrimitive(
        {{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}},
         {"extensions", {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", ids}}}}}});
    return builder;
}

TEST(GltfExtensions, NormalizeColorsOfDracoOnce) {
    for (const bool normalized : {false, true}) {
        const Scene scene = dracoColors<std::uint8_t>(draco::DT_UINT8, normalized, 255, 51).load();
        std::vector<int> reds;
        for (const Vertex& vertex : scene.meshes.at(0).vertices) {
            reds.push_back(vertex.color.x);
        }
        std::ranges::sort(reds);
        EXPECT_EQ(reds, (std::vector{13107, 13107, 65535})) << normalized;
    }
}

TEST(GltfExtensions, RefuseBoolsOfDraco) {
    const std::string error = dracoColors<bool>(draco::DT_BOOL, false, true, false).error();
    EXPECT_NE(error.find("attributes.COLOR_0 has components that are true or false"), std::string::npos) << error;
}

TEST(GltfExtensions, SurviveDamagedDraco) {
    const GltfBuilder whole = dracoMesh(40);
    for (std::size_t size = 0; size < whole.binary.size(); ++size) {
        GltfBuilder builder = whole;
        builder.json["bufferViews"][0]["byteLength"] = size;
        EXPECT_NE(builder.error(), "") << size;
    }
    std::mt19937 random(3);
    for (int round = 0; round < 1000; ++round) {
        GltfBuilder builder = whole;
        builder.binary[random() % builder.binary.size()] = static_cast<std::uint8_t>(random());
        builder.error();
    }
}

TEST(GltfExtensions, TransformTextureCoordinates) {
    GltfBuilder builder;
    builder.setSquare()["material"] = 0;
    const Json transform = {{"offset", {0.25, 0.5}}, {"rotation", 1.5707963267948966}, {"scale", {2, 3}}};
    builder.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR"
                                       "42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg=="}}};
    const glm::mat3 uv = builder.load().surfaces.at(0).baseColorUv.transform;
    // Counter-clockwise rotation about the origin with v downwards, after the scale and before the offset.
    expectVec3(uv * glm::vec3(1, 0, 1), {0.25f, 0.5f - 2, 1});
    expectVec3(uv * glm::vec3(0, 1, 1), {0.25f + 3, 0.5f, 1});
}

const Json volume = {
    {"thicknessFactor", 0.02}, {"attenuationDistance", 0.004}, {"attenuationColor", {0.5, 0.25, 0.125}}};

TEST(GltfExtensions, MapDenseMediaInBothSpellings) {
    const Json diffuse = {{"diffuseTransmissionFactor", 0.75}};
    const Json spellings[]{
        {{"KHR_materials_volume", volume},
         {"KHR_materials_diffuse_transmission", diffuse},
         {"KHR_materials_volume_scatter", {{"multiscatterColor", {0.9, 0.8, 0.5}}, {"scatterAnisotropy", 0.5}}}},
        {{"KHR_materials_volume", volume},
         {"KHR_materials_diffuse_transmission", diffuse},
         {"KHR_materials_volume_scatter", {{"multiscatterColorFactor", {0.9, 0.8, 0.5}}, {"scatterAnisotropy", 0.5}}}},
        {{"KHR_materials_volume", volume},
         {"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
         {"KHR_materials_scatter",
          {{"scatterStrengthFactor", 1}, {"multiscatterColorFactor", {0.9, 0.8, 0.5}}, {"scatterAnisotropy", 0.5}}}}};
    for (const Json& extensions : spellings) {
        const Scene scene = squareWith(extensions).load();
        ASSERT_EQ(scene.materials.size(), 1u) << extensions;
        const Material& material = scene.materials[0];
        EXPECT_EQ(findFault(material), "");
        EXPECT_EQ(material.name, "test");
        EXPECT_DOUBLE_EQ(material.strength, 0.75);
        EXPECT_FLOAT_EQ(scene.surfaces[0].thickness, 20);
        const double albedos[]{0.9, 0.8, 0.5};
        const double colors[]{0.5, 0.25, 0.125};
        for (int c = 0; c < 3; ++c) {
            const double extinction = -std::log(colors[c]) / 4; // 1/mm
            const double alpha = singleScatteringAlbedo(albedos[c], 0.5);
            const double shape = 1.9 - albedos[c] + 3.5 * std::pow(albedos[c] - 0.8, 2);
            const double expected = 1 / (extinction * (1 - alpha * 0.5)) / shape;
            EXPECT_NEAR((*material.meanFreePath)[static_cast<std::size_t>(c)], expected, 1e-4 * expected);
        }
    }
}

/// A PNG of two texels: (255, 188, 0) and (188, 64, 128).
const std::string twoTexels =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR4nGP4v4dhj0MDAAzhAzjSsCbOAAAAAElFTkSuQmCC";

TEST(GltfExtensions, MakeLengthsOfATextureOfColours) {
    const std::array factor{1.0, 0.5, 1.0};
    const auto squareOf = [&](const Json& colors) {
        GltfBuilder builder = squareWith({{"KHR_materials_volume", volume},
                                          {"KHR_materials_volume_scatter",
                                           {{"multiscatterColorFactor", factor},
                                            {"scatterAnisotropy", 0.5},
                                            {"multiscatterColorTexture", colors}}}});
        builder.json["images"] = {{{"uri", twoTexels}}};
        builder.json["textures"] = {{{"source", 0}}};
        return builder;
    };
    const Scene scene = squareOf({{"index", 0}}).load();
    const Surface& surface = scene.surfaces.at(0);
    const Texture& colors = scene.textures.at(surface.baseColorTexture);
    const Texture& lengths = scene.textures.at(surface.scaleTexture);
    EXPECT_TRUE(colors.srgb);
    EXPECT_FALSE(lengths.srgb);
    ASSERT_EQ(lengths.pixels.size(), 8u);
    const std::array<double, 256> linear = linearValues(true);
    const GltfMedium medium{.attenuationDistance = 0.004, .attenuationColor = {0.5f, 0.25f, 0.125f}, .anisotropy = 0.5};
    for (std::size_t texel = 0; texel < 2; ++texel) {
        double expected = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double color = factor[c] * linear[colors.pixels[4 * texel + c]];
            const double there = denseMeanFreePath(medium, static_cast<int>(c), color);
            expected += there / scene.materials.at(0).meanFreePath->at(c) / 3;
        }
        const double actual = surface.scale * static_cast<float>(lengths.pixels[4 * texel]) / 255;
        EXPECT_NEAR(actual, expected, surface.scale / 255) << texel;
    }
    EXPECT_EQ(std::max(lengths.pixels[0], lengths.pixels[4]), 255);
    EXPECT_LT(std::min(lengths.pixels[0], lengths.pixels[4]), 250);
    EXPECT_TRUE(scene.notes.empty());
}

TEST(GltfExtensions, MakeNoLengthsOfOneColour) {
    GltfBuilder builder =
        squareWith({{"KHR_materials_volume", volume},
                    {"KHR_materials_volume_scatter",
                     {{"multiscatterColorFactor", {0, 0.5, 0}}, {"multiscatterColorTexture", {{"index", 0}}}}}});
    // Green of both texels is the same.
    builder.json["images"] = {
        {{"uri", "data:image/"
                 "png;base64,"
                 "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR4nGP4n8KwJ6UBAAtxAwQ0eAJWAAAAAElFTkSuQmCC"}}};
    builder.json["textures"] = {{{"source", 0}}};
    const Scene scene = builder.load();
    EXPECT_EQ(scene.surfaces.at(0).scaleTexture, none);
    EXPECT_EQ(scene.surfaces[0].scale, 1);
}

TEST(GltfExtensions, KeepTheDefaultsOfTheSpecifications) {
    // KHR_materials_scatter: strength 0 does not scatter. KHR_materials_volume_scatter: black does not.
    EXPECT_TRUE(squareWith({{"KHR_materials_volume", volume}, {"KHR_materials_scatter", Json::object()}})
                    .load()
                    .materials.empty());
    EXPECT_TRUE(squareWith({{"KHR_materials_volume", volume}, {"KHR_materials_volume_scatter", Json::object()}})
                    .load()
                    .materials.empty());
    EXPECT_TRUE(squareWith({{"KHR_materials_volume", volume}}).load().materials.empty());
    EXPECT_TRUE(squareWith({{"KHR_materials_diffuse_transmission", Json::object()}}).load().materials.empty());
}

TEST(GltfExtensions, MapThinWalls) {
    const Scene leaf =
        squareWith({{"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.4}}}}).load();
    ASSERT_EQ(leaf.materials.size(), 1u);
    EXPECT_DOUBLE_EQ(leaf.materials[0].diffuseTransmission, 0.4);
    EXPECT_DOUBLE_EQ(leaf.materials[0].translucency, 1);
    EXPECT_EQ(leaf.materials[0].diffuseTransmissionColor, (Rgb{1, 1, 1})); // not the base colour
    const auto profile = makeProfile(leaf.materials[0]);
    EXPECT_GT(profile->slabTransmittance(0, leaf.surfaces[0].thickness), 0.98);
    const Scene sheet = squareWith({{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                                    {"KHR_materials_scatter",
                                     {{"scatterStrengthFactor", 1},
                                      {"multiscatterColorFactor", {0.6, 0.7, 0.8}},
                                      {"scatterAnisotropy", 0.5}}}})
                            .load();
    ASSERT_EQ(sheet.materials.size(), 1u);
    EXPECT_DOUBLE_EQ(sheet.materials[0].diffuseTransmission, 0.75); // forward share (1 + g)/2
    EXPECT_FALSE(sheet.materials[0].diffuseTransmissionColor);      // both sides have the medium's colour
    expectVec3(glm::vec3(sheet.surfaces[0].baseColor), {0.6f, 0.7f, 0.8f});
}

TEST(GltfExtensions, MatchTheAttenuationOfVolumesThatDoNotScatter) {
    const Scene scene = squareWith({{"KHR_materials_volume", volume},
                                    {"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.5}}}})
                            .load();
    ASSERT_EQ(scene.materials.size(), 1u);
    const auto profile = makeProfile(scene.materials[0]);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(profile->slabTransmittance(c, 4), std::pow(0.5, c + 1), 1e-6);
    }
}

TEST(GltfExtensions, TakeMediaWithClearChannels) {
    const Json colors[]{{1, 1, 1}, {1, 0.5, 0}, {0, 0, 0}};
    for (const Json& attenuation : colors) {
        for (const Json& scattered : colors) {
            for (const double distance : {0.0, 1e-9, 0.004, std::numeric_limits<double>::max()}) {
                const Json clear = {
                    {"thicknessFactor", 0.02}, {"attenuationDistance", distance}, {"attenuationColor", attenuation}};
                const Json scatter = {{"multiscatterColorFactor", scattered}, {"scatterAnisotropy", 1}};
                const Json diffuse = {{"diffuseTransmissionFactor", 0.5}};
                for (const Json& extensions :
                     {Json{{"KHR_materials_volume", clear}},
                      Json{{"KHR_materials_volume", clear}, {"KHR_materials_diffuse_transmission", diffuse}},
                      Json{{"KHR_materials_volume", clear},
                           {"KHR_materials_diffuse_transmission", diffuse},
                           {"KHR_materials_volume_scatter", scatter}}}) {
                    for (const Material& material : squareWith(extensions).load().materials) {
                        EXPECT_EQ(findFault(material), "") << extensions;
                    }
                }
            }
        }
    }
}

TEST(GltfExtensions, NameTheFieldThatIsOutOfRange) {
    EXPECT_EQ(squareWith({{"KHR_materials_volume", {{"thicknessFactor", -2}}}}).error(),
              "test.glb: materials[0].extensions.KHR_materials_volume.thicknessFactor is -2, must be 0 to 1e+09");
    EXPECT_EQ(
        squareWith({{"KHR_materials_volume_scatter", {{"scatterAnisotropy", 3}}}, {"KHR_materials_volume", volume}})
            .error(),
        "test.glb: materials[0].extensions.KHR_materials_volume_scatter.scatterAnisotropy is 3, must be -1 to 1");
    EXPECT_EQ(squareWith({{"KHR_materials_volume", {{"attenuationColor", {1, 2}}}}}).error(),
              "test.glb: materials[0].extensions.KHR_materials_volume.attenuationColor must be an array of 3 numbers");
}

} // namespace
