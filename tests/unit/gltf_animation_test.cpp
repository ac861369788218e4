// glTF animations at a time.
#include "tests/support/gltf_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace nacre::scene;
using nacre::test::GltfBuilder;

namespace {

class GltfAnimation : public testing::Test {
protected:
    GltfAnimation() { builder.setSquare(); }

    /// A channel of node 0.
    void animate(const std::string& path, const std::vector<float>& times, const std::vector<float>& values,
                 const char* type, std::size_t components, const std::string& interpolation = "LINEAR") {
        auto& animation = builder.json["animations"][0];
        const std::size_t input = builder.addFloats(times, "SCALAR", 1);
        const std::size_t output = builder.addFloats(values, type, components);
        animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", 0}, {"path", path}}}});
    }

    Scene at(double time) {
        const std::vector<std::uint8_t> bytes = builder.glb();
        return loadGltf("test.glb", bytes, time);
    }
    glm::vec3 placeAt(double time) { return glm::vec3(at(time).instances.at(0).transform[3]); }
    std::string errorAt(double time) {
        try {
            at(time);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    }

    GltfBuilder builder;
};

TEST_F(GltfAnimation, MovesStraightBetweenItsKeys) {
    animate("translation", {1, 3}, {0, 0, 0, 2, 4, 6}, "VEC3", 3);
    EXPECT_EQ(placeAt(0), glm::vec3(0));
    EXPECT_EQ(placeAt(1.5), glm::vec3(0.5f, 1, 1.5f));
    EXPECT_EQ(placeAt(3), glm::vec3(2, 4, 6));
    EXPECT_EQ(placeAt(100), glm::vec3(2, 4, 6));
    EXPECT_EQ(glm::vec3(builder.load().instances.at(0).transform[3]), glm::vec3(0)); // not asked for
}

TEST_F(GltfAnimation, StepsAndBends) {
    animate("translation", {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3", 3, "STEP");
    EXPECT_EQ(placeAt(0.99), glm::vec3(0));
    EXPECT_EQ(placeAt(1), glm::vec3(1));
    // Hermite: values 0 and 1, tangents 1 a second out of the first key and 0 into the second.
    animate("scale", {0, 2}, {9, 9, 9, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1, 9, 9, 9}, "VEC3", 3, "CUBICSPLINE");
    EXPECT_NEAR(at(1).instances.at(0).transform[0][0], 0.5 + 2 * 0.125, 1e-6);
}

TEST_F(GltfAnimation, TurnsTheShortWay) {
    const float half = std::numbers::sqrt2_v<float> / 2;
    animate("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, -half, -half}, "VEC4", 4); // a quarter about z, negated
    const glm::mat4 turned = at(0.5).instances.at(0).transform;
    EXPECT_NEAR(turned[0][0], half, 1e-6);
    EXPECT_NEAR(turned[0][1], half, 1e-6);
}

TEST_F(GltfAnimation, MovesMorphTargetsAndSkins) {
    auto& primitive = builder.json["meshes"][0]["primitives"][0];
    const std::vector<float> up{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    primitive["targets"] = {{{"POSITION", builder.addFloats(up, "VEC3", 3)}},
                            {{"POSITION", builder.addFloats(up, "VEC3", 3)}}};
    animate("weights", {0, 1}, {0, 0, 1, 3}, "SCALAR", 1);
    EXPECT_FLOAT_EQ(at(0.5).meshes.at(0).vertices.at(0).position.z, 2);
    EXPECT_FLOAT_EQ(at(0).meshes.at(0).vertices.at(0).position.z, 0);

    primitive["attributes"]["JOINTS_0"] =
        builder.addAccessor(builder.addView(std::vector<std::uint8_t>(16, std::uint8_t{0})), 5121, 4, "VEC4");
    primitive["attributes"]["WEIGHTS_0"] =
        builder.addFloats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    builder.json["skins"] = {{{"joints", {0}}}};
    builder.json["nodes"] = {{{"name", "joint"}}, {{"mesh", 0}, {"skin", 0}}};
    builder.json["scenes"][0]["nodes"] = {0, 1};
    builder.json["animations"].clear();
    animate("translation", {0, 1}, {0, 0, 0, 5, 0, 0}, "VEC3", 3);
    EXPECT_FLOAT_EQ(at(0.5).meshes.at(0).vertices.at(0).position.x, 2.5f);
}

TEST_F(GltfAnimation, TakesThePlaceOfAMatrix) {
    builder.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1};
    animate("translation", {0}, {1, 2, 3}, "VEC3", 3);
    EXPECT_EQ(placeAt(0), glm::vec3(1, 2, 3));
}

TEST_F(GltfAnimation, TellsWhatIsLeftOut) {
    EXPECT_EQ(at(1).notes, std::vector<std::string>{"test.glb: has no animation, and looks the same at every time"});
    animate("translation", {0}, {1, 2, 3}, "VEC3", 3);
    animate("pointer", {0}, {1, 2, 3}, "VEC3", 3);
    builder.json["animations"].push_back(builder.json["animations"][0]);
    EXPECT_EQ(at(1).notes,
              (std::vector<std::string>{"test.glb: has 2 animations, of which the first is shown",
                                        "test.glb: 1 channels of its animation move something that is not read"}));
}

TEST_F(GltfAnimation, IsRefusedInASentence) {
    animate("translation", {0, 1}, {1, 2, 3}, "VEC3", 3);
    EXPECT_EQ(errorAt(0), "test.glb: animations[0].samplers[0].output has 3 numbers, which do not fit its 2 keys");
    auto& channel = builder.json["animations"][0]["channels"][0];
    channel["target"]["node"] = 9;
    EXPECT_EQ(errorAt(0), "test.glb: animations[0].channels[0].target.node is 9, but there are only 1");
    channel["target"]["node"] = 0;
    channel["sampler"] = 5;
    EXPECT_EQ(errorAt(0), "test.glb: animations[0].channels[0].sampler is 5, but there are only 1");
    channel["sampler"] = "x";
    EXPECT_NE(errorAt(0).find("animations[0].channels[0].sampler is \"x\", must be a whole number"), std::string::npos);
    channel["sampler"] = 0;
    builder.json["animations"][0]["samplers"][0]["interpolation"] = "SMOOTH";
    EXPECT_EQ(errorAt(0), "test.glb: animations[0].samplers[0].interpolation must be LINEAR, STEP or CUBICSPLINE");
}

// A small file whose channels all read one long sampler.
TEST_F(GltfAnimation, MayNotTakeLongerThanItsFile) {
    std::vector<float> times(100'000);
    for (std::size_t i = 0; i < times.size(); ++i) {
        times[i] = static_cast<float>(i);
    }
    animate("translation", times, std::vector<float>(3 * times.size()), "VEC3", 3);
    auto& channels = builder.json["animations"][0]["channels"];
    channels = std::vector<nlohmann::json>(10'000, channels[0]);
    EXPECT_TRUE(errorAt(1).starts_with("test.glb: needs more than ")) << errorAt(1);
}

} // namespace
