// Skins with several sets of joints, and morph targets of every attribute.
#include "tests/support/gltf_builder.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace {

using nacre::scene::Bounds;
using nacre::scene::Scene;
using nacre::scene::Vertex;
using nacre::test::GltfBuilder;
using Json = nlohmann::json;

void expectNear(const glm::vec3& actual, const glm::vec3& expected) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(actual[i], expected[i], 1e-5f) << i;
    }
}

/// A square whose corners all have `sets` sets of four joints: joint j stands at z = j, and has the j-th weight.
class SkinnedSquare : public GltfBuilder {
public:
    explicit SkinnedSquare(const std::vector<float>& weights) : attributes_(setSquare()["attributes"]) {
        json["nodes"] = {{{"mesh", 0}, {"skin", 0}}};
        for (std::size_t joint = 0; joint < weights.size(); ++joint) {
            json["nodes"].push_back({{"translation", {0, 0, joint}}});
            json["scenes"][0]["nodes"].push_back(joint + 1);
            json["skins"][0]["joints"].push_back(joint + 1);
        }
        for (std::size_t set = 0; set < weights.size() / 4; ++set) {
            std::vector<std::uint16_t> joints;
            std::vector<float> weightsOfSet;
            for (std::size_t i = 0; i < 16; ++i) {
                joints.push_back(static_cast<std::uint16_t>(set * 4 + i % 4));
                weightsOfSet.push_back(weights[set * 4 + i % 4]);
            }
            const std::string number = std::to_string(set);
            json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_" + number] =
                addAccessor(addView(joints), 5123, 4, "VEC4");
            json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_" + number] = addFloats(weightsOfSet, "VEC4", 4);
        }
    }
    Json& attributes() { return json["meshes"][0]["primitives"][0]["attributes"]; }
    float height() { return bounds(load()).high.z; }

private:
    Json& attributes_;
};

TEST(GltfDeformation, AllSetsOfJointsCount) {
    EXPECT_NEAR(SkinnedSquare({0, 0.5f, 0, 0, 0, 0, 0.5f, 0}).height(), 3.5f, 1e-5f);
    EXPECT_NEAR(SkinnedSquare({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.25f, 0.75f}).height(), 10.75f, 1e-5f);
    std::vector<float> many(4 * 40, 0.0f); // more sets than have one digit
    many[159] = 1;
    EXPECT_NEAR(SkinnedSquare(many).height(), 159, 1e-4f);
}

TEST(GltfDeformation, WeightsAreDividedByTheirSumOverAllSets) {
    EXPECT_NEAR(SkinnedSquare({0, 2, 0, 0, 0, 0, 6, 0}).height(), (2 * 1 + 6 * 6) / 8.0f, 1e-5f);
    EXPECT_NEAR(SkinnedSquare({0, 0, 0, 0, 0, 0, 0, 0}).height(), 0, 1e-5f);
}

TEST(GltfDeformation, IntegerWeightsOfEverySetAreNormalised) {
    SkinnedSquare square({0, 1, 0, 0, 0, 0, 0, 1});
    const auto weights = square.addView(std::vector<std::uint8_t>{0, 51, 0, 0, 0, 51, 0, 0, 0, 51, 0, 0, 0, 51, 0, 0});
    square.json["accessors"][square.addAccessor(weights, 5121, 4, "VEC4")]["normalized"] = true;
    square.attributes()["WEIGHTS_0"] = square.json["accessors"].size() - 1;
    EXPECT_NEAR(square.height(), (0.2f * 1 + 1 * 7) / 1.2f, 1e-5f);
}

TEST(GltfDeformation, GapsInTheSetsAreRefused) {
    const auto errorWithout = [](const char* attribute) {
        SkinnedSquare square(std::vector<float>(12, 1 / 12.0f));
        square.attributes().erase(attribute);
        return square.error();
    };
    for (const char* attribute : {"JOINTS_0", "WEIGHTS_1", "JOINTS_2"}) {
        EXPECT_EQ(errorWithout(attribute), "test.glb: meshes[0].primitives[0].attributes has no " +
                                               std::string(attribute) + ", but joints or weights up to set 2");
    }
    SkinnedSquare square(std::vector<float>(12, 1 / 12.0f));
    square.attributes().erase("JOINTS_1");
    square.attributes().erase("WEIGHTS_1");
    EXPECT_NE(square.error().find("has no JOINTS_1, but"), std::string::npos) << square.error();
    square.json["nodes"][0].erase("skin"); // without a skin nobody asks
    EXPECT_EQ(square.error(), "");
}

TEST(GltfDeformation, WhatHasNoWeightMayNameAnyJoint) {
    SkinnedSquare square({0, 0, 0, 1, 0, 0, 0, 0});
    square.json["skins"][0]["joints"] = {1, 2, 3, 4};
    EXPECT_NEAR(square.height(), 3, 1e-5f);
    square.json["skins"][0]["joints"] = {1, 2, 3};
    EXPECT_NE(square.error().find("JOINTS_0 names a joint that skins[0] does not have"), std::string::npos);
}

TEST(GltfDeformation, ManySetsThatShareBytesAreRefused) {
    SkinnedSquare square({0, 0, 0, 1});
    constexpr std::size_t vertices = 20'000;
    square.attributes()["POSITION"] = square.addFloats(std::vector<float>(vertices * 3), "VEC3", 3);
    square.attributes().erase("TEXCOORD_0");
    const auto shared =
        square.addAccessor(square.addView(std::vector<std::uint8_t>(vertices * 4)), 5121, vertices, "VEC4");
    for (int set = 0; set < 2000; ++set) {
        square.attributes()["JOINTS_" + std::to_string(set)] = shared;
        square.attributes()["WEIGHTS_" + std::to_string(set)] = shared;
    }
    EXPECT_TRUE(square.error().starts_with("test.glb: needs more than ")) << square.error().substr(0, 100);
}

// A joint that scales x by a half leans a slanted normal the other way than it leans the surface.
TEST(GltfDeformation, NormalsAndTangentsFollowTheSkin) {
    SkinnedSquare square({1, 0, 0, 0});
    const float half = std::sqrt(0.5f);
    std::vector<float> normals;
    std::vector<float> tangents;
    for (int i = 0; i < 4; ++i) {
        normals.insert(normals.end(), {half, 0, half});
        tangents.insert(tangents.end(), {half, 0, -half, 1});
    }
    square.attributes()["NORMAL"] = square.addFloats(normals, "VEC3", 3);
    square.attributes()["TANGENT"] = square.addFloats(tangents, "VEC4", 4);
    square.json["nodes"][1]["scale"] = {0.5, 1, 1};
    const Scene scene = square.load();
    for (const Vertex& vertex : scene.meshes.at(0).vertices) {
        expectNear(vertex.normal, glm::normalize(glm::vec3(2, 0, 1)));
        expectNear(glm::vec3(vertex.tangent), glm::normalize(glm::vec3(0.5f, 0, -1)));
    }
}

TEST(GltfDeformation, MorphTargetsMoveEveryAttributeThatIsRead) {
    GltfBuilder builder;
    Json& primitive = builder.setSquare();
    const auto four = [&](const std::vector<float>& value, const char* type) {
        std::vector<float> all;
        for (int i = 0; i < 4; ++i) {
            all.insert(all.end(), value.begin(), value.end());
        }
        return builder.addFloats(all, type, value.size());
    };
    primitive["attributes"]["NORMAL"] = four({0, 0, 1}, "VEC3");
    primitive["attributes"]["TANGENT"] = four({1, 0, 0, -1}, "VEC4");
    primitive["attributes"]["COLOR_0"] = four({0, 0, 1, 1}, "VEC4");
    primitive["targets"] = {{{"TANGENT", four({-2, 0, 0}, "VEC3")},
                             {"TEXCOORD_0", four({10, 20}, "VEC2")},
                             {"COLOR_0", four({1, 0, -1, -1}, "VEC4")}}};
    builder.json["meshes"][0]["weights"] = {0.5};
    {
        const Vertex vertex = builder.load().meshes.at(0).vertices.at(0); // at (0, 1) of the picture
        EXPECT_EQ(vertex.uv, glm::vec2(5, 11));
        EXPECT_EQ(vertex.color, (glm::vec<4, std::uint16_t>(32768, 0, 32768, 32768)));
    }
    builder.json["meshes"][0]["weights"] = {1};
    const Vertex vertex = builder.load().meshes.at(0).vertices.at(0);
    expectNear(glm::vec3(vertex.tangent), {-1, 0, 0});
    EXPECT_EQ(vertex.tangent.w, -1); // which is not morphed
    primitive["targets"][0]["TEXCOORD_0"] = four({1, 1, 1}, "VEC3");
    EXPECT_NE(builder.error().find("targets[0].TEXCOORD_0"), std::string::npos) << builder.error();
}

} // namespace
