// Scenes of a hundred thousand things: loaded, or refused, in time that grows with their number.
#include "scene/default_view.hpp"
#include "scene/files/scene_file.hpp"
#include "scene/outline.hpp"

#include "tests/support/gltf_builder.hpp"
#include "tests/support/processor_time.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

using namespace nacre::scene;
using nacre::test::GltfBuilder;
using Json = nlohmann::json;

namespace {

/// Under the sanitizers everything takes ten times as long.
#ifdef NACRE_SANITIZED
constexpr int many = 10'000;
#else
constexpr int many = 100'000;
#endif

/// Loads as a command does, and holds it to the seconds.
Scene load(GltfBuilder& builder, double seconds) {
    const std::vector<std::uint8_t> bytes = builder.glb();
    const double start = nacre::tests::processorSeconds();
    Scene scene = loadGltf("many.glb", bytes);
    fitLights(scene);
    addMissingViewAndLights(scene);
    EXPECT_LT(nacre::tests::processorSeconds() - start, seconds);
    return scene;
}

/// `count` nodes of which each is `make(i)`, all roots.
template <typename Make> void setNodes(GltfBuilder& builder, int count, const Make& make) {
    std::vector<Json> nodes;
    std::vector<int> roots;
    for (int i = 0; i < count; ++i) {
        nodes.push_back(make(i));
        roots.push_back(i);
    }
    builder.json["nodes"] = std::move(nodes);
    builder.json["scenes"][0]["nodes"] = std::move(roots);
}

TEST(Many, Instances) {
    GltfBuilder builder;
    builder.setSquare();
    const auto places = builder.addFloats(std::vector<float>(3 * many, 1.0f), "VEC3", 3);
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    const Scene scene = load(builder, 10);
    EXPECT_EQ(scene.instances.size(), static_cast<std::size_t>(many));
    EXPECT_EQ(scene.meshes.size(), 1u);
}

TEST(Many, NodesInAFan) {
    GltfBuilder builder;
    builder.setSquare();
    setNodes(builder, many, [](int i) { return Json{{"mesh", 0}, {"translation", {i % 300, i / 300, 0}}}; });
    EXPECT_EQ(load(builder, 5).meshes.size(), 1u);
}

TEST(Many, NodesInAChain) {
    GltfBuilder builder;
    builder.setSquare();
    setNodes(builder, many, [](int i) {
        return i + 1 < many ? Json{{"children", {i + 1}}, {"translation", {0.001, 0, 0}}} : Json{{"mesh", 0}};
    });
    builder.json["scenes"][0]["nodes"] = {0};
    EXPECT_NEAR(load(builder, 5).instances.at(0).transform[3].x, 0.001 * many, 0.01);
}

TEST(Many, Lights) {
    GltfBuilder builder;
    builder.setSquare();
    setNodes(builder, many, [](int i) {
        return i == 0 ? Json{{"mesh", 0}} : Json{{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
    });
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}}};
    EXPECT_EQ(load(builder, 5).lights.size(), static_cast<std::size_t>(many - 1));
}

TEST(Many, Materials) {
    GltfBuilder builder;
    const Json primitive = builder.setSquare();
    std::vector<Json> primitives(many, primitive);
    std::vector<Json> materials;
    for (int i = 0; i < many; ++i) {
        primitives[static_cast<std::size_t>(i)]["material"] = i;
        materials.push_back({{"pbrMetallicRoughness", {{"roughnessFactor", i / (2.0 * many)}}}});
    }
    builder.json["meshes"][0]["primitives"] = std::move(primitives);
    builder.json["materials"] = std::move(materials);
    EXPECT_EQ(load(builder, 10).surfaces.size(), static_cast<std::size_t>(many));
}

TEST(Many, AccessorsWithoutViews) {
    GltfBuilder builder;
    builder.setSquare();
    std::vector<Json> accessors(many, {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    std::vector<Json> meshes;
    for (int i = 0; i < many; ++i) {
        meshes.push_back({{"primitives", {{{"attributes", {{"POSITION", i}}}}}}});
    }
    builder.json["accessors"] = std::move(accessors);
    builder.json["meshes"] = std::move(meshes);
    setNodes(builder, many, [](int i) { return Json{{"mesh", i}}; });
    EXPECT_EQ(load(builder, 10).meshes.size(), static_cast<std::size_t>(many));
}

TEST(Many, ModelsOfASceneFile) {
    const nacre::tests::TemporaryFolder folder;
    GltfBuilder builder;
    builder.setSquare();
    const std::vector<std::uint8_t> glb = builder.glb();
    std::ofstream(folder.path / "square.glb").write(reinterpret_cast<const char*>(glb.data()), glb.size());
    std::vector<Json> models;
    for (int i = 0; i < many; ++i) {
        models.push_back({{"model", "square.glb"}, {"translate", {i, 0, 0}}});
    }
    const std::string text = Json{{"models", models}}.dump();
    const double start = nacre::tests::processorSeconds();
    const Scene scene =
        readSceneFile(folder.path / "many.json", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    EXPECT_LT(nacre::tests::processorSeconds() - start, 10);
    EXPECT_EQ(scene.instances.size(), static_cast<std::size_t>(many));
    EXPECT_EQ(scene.meshes.size(), 1u);
}

// A mesh with many vertices in many places: its box stands in for it.
TEST(Many, VerticesPlacedOften) {
    Scene scene;
    Mesh mesh;
    constexpr int side = 2000;
    for (int i = 0; i < side; ++i) {
        mesh.vertices.push_back({.position = glm::vec3(i, i * 7 % side, i * 13 % side) / (side - 1.0f)});
    }
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"one", 0, glm::mat4(1)});
    EXPECT_EQ(Outline(scene).of(0).size(), mesh.vertices.size());
    const Bounds exact = bounds(scene);
    scene.instances.resize(many, scene.instances[0]);
    EXPECT_EQ(Outline(scene).of(0).size(), 8u);
    EXPECT_EQ(bounds(scene).low, exact.low);
    EXPECT_EQ(bounds(scene).high, exact.high);
}

} // namespace
