// Local thickness where it is known in closed form, and what a bake promises whatever happens.
#include "bake/thickness_bake.hpp"
#include "bake/thickness_files.hpp"
#include "image/image_file.hpp"
#include "nacre/files.hpp"
#include "nacre/presets.hpp"
#include "tests/support/reference_scenes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "trace/texture_lookup.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

using namespace nacre;
using namespace nacre::test;
using bake::Atlas;
using bake::Chords;
using bake::localThickness;
using bake::LocalThickness;
using bake::ThicknessBake;
using bake::ThicknessLaw;
using bake::ThicknessState;

ThicknessLaw skinLaw() {
    return ThicknessLaw(*makeProfile(*findPreset("skin-burley")));
}

/// Millimetres; a body of the skin that skinLaw is of.
scene::Scene sceneOf(scene::Mesh mesh) {
    scene::Scene scene = darkScene();
    addMesh(scene, std::move(mesh), addSurface(scene, findPreset("skin-burley")));
    return scene;
}

/// Beneath the surface that is met from `origin` in this direction.
LocalThickness thicknessAt(const scene::Scene& scene, const ThicknessLaw& law, const glm::vec3& origin,
                           const glm::vec3& direction, std::uint32_t samples = 4096) {
    trace::Geometry geometry(scene);
    const Chords chords(geometry);
    trace::Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    trace::Hit hit = geometry.closest(ray).value();
    hit.distance = 0;
    return localThickness(chords, law, hit, samples, trace::Random(1, 7, 0));
}

TEST(ThicknessLaw, MeanOfASlabIsItsOwnThickness) {
    for (const ThicknessLaw& law : {ThicknessLaw(), skinLaw()}) {
        for (const double thickness : {0.05, 0.3, 1.0, 4.0, 12.0}) {
            EXPECT_NEAR(law.thickness(law.slabMean(thickness)), thickness, 2e-3 * thickness);
        }
    }
    EXPECT_EQ(skinLaw().thickness(1), 0);
    EXPECT_EQ(skinLaw().thickness(0), skinLaw().longest());
    EXPECT_LT(skinLaw().slabMean(skinLaw().longest()), 1e-4);
}

// The mean over the cosine of T(t/µ), by Burley's T = (e^{-c/d} + 3 e^{-c/3d})/4 and its own rule.
TEST(ThicknessLaw, TransmittanceIsTheProfilesOwn) {
    const Material& skin = *findPreset("skin-burley");
    const ThicknessLaw law = skinLaw();
    for (const double chord : {0.1, 0.7, 2.0, 9.0}) {
        double expected = 0;
        for (const double d : skin.meanFreePath.value()) {
            expected += (std::exp(-chord / d) + 3 * std::exp(-chord / (3 * d))) / 12;
        }
        EXPECT_NEAR(law.transmittance(chord), expected, 2e-5);
    }
    EXPECT_EQ(law.transmittance(std::numeric_limits<double>::infinity()), 0);
}

TEST(LocalThickness, OfASlabIsItsThickness) {
    for (const float thickness : {0.5f, 3.0f}) {
        const scene::Scene slab = sceneOf(box({-400, -thickness, -400}, {400, 0, 400}));
        EXPECT_NEAR(thicknessAt(slab, skinLaw(), {3, 5, 2}, {0, -1, 0}).millimetres, thickness, 4e-3 * thickness);
        // Sides 400 mm away shorten the flattest chords a little.
        EXPECT_NEAR(thicknessAt(slab, ThicknessLaw(), {3, 5, 2}, {0, -1, 0}).millimetres, thickness, 0.01 * thickness);
    }
}

// The chord of a ball of diameter D at the cosine µ is Dµ. Neutral: the mean of 1/(Dµ) is 2/D, the slab's 2/(3t), and
// so t = D/3.
TEST(LocalThickness, OfABallIsByItsChords) {
    constexpr float radius = 4;
    const scene::Scene scene = sceneOf(ball(radius, 192));
    EXPECT_NEAR(thicknessAt(scene, ThicknessLaw(), {0, 9, 1}, {0, -1, -0.1f}).millimetres, 2 * radius / 3, 0.02);
    const ThicknessLaw law = skinLaw();
    constexpr int steps = 20000;
    double mean = 0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        mean += 2 * cosine * law.transmittance(2 * radius * cosine) / steps;
    }
    const double expected = law.thickness(mean);
    EXPECT_GT(expected, 0.3 * radius);
    EXPECT_LT(expected, 2 * radius);
    EXPECT_NEAR(thicknessAt(scene, law, {0, 9, 1}, {0, -1, -0.1f}).millimetres, expected, 0.01 * expected);
}

TEST(LocalThickness, KnowsUnitsAndOverlappingBodies) {
    scene::Scene slab = sceneOf(box({-400, -2, -400}, {400, 0, 400}));
    slab.metersPerUnit = 0.01; // centimetres
    EXPECT_NEAR(thicknessAt(slab, ThicknessLaw(), {3, 5, 2}, {0, -1, 0}).millimetres, 20, 0.2);
    // A second slab that begins inside of the first and ends below it.
    scene::Scene two = sceneOf(box({-400, -2, -400}, {400, 0, 400}));
    addMesh(two, box({-400, -5, -400}, {400, -1, 400}), 0);
    EXPECT_NEAR(thicknessAt(two, ThicknessLaw(), {3, 5, 2}, {0, -1, 0}).millimetres, 5, 0.05);
    // A grey block below it is no body that light goes through.
    addMesh(two, box({-400, -9, -400}, {400, -4, 400}), addSurface(two, nullptr));
    EXPECT_NEAR(thicknessAt(two, ThicknessLaw(), {3, 5, 2}, {0, -1, 0}).millimetres, 5, 0.05);
}

TEST(LocalThickness, NothingComesThroughAnOpenMesh) {
    const scene::Scene sheet = sceneOf(rectangle({-5, -5}, {5, 5}, 0));
    const LocalThickness open = thicknessAt(sheet, skinLaw(), {0, 5, 0}, {0, -1, 0}, 64);
    EXPECT_EQ(open.escaped, 64u);
    EXPECT_NEAR(open.millimetres, std::min(skinLaw().longest(), std::sqrt(200.0)), 1e-5);
}

/// A slab of 2 mm whose upper side has the left half of the picture but for a margin, and its lower side a strip at the
/// right.
scene::Scene mappedSlab() {
    scene::Mesh mesh;
    const auto addFace = [&mesh](float y, float side, const glm::vec2& low, const glm::vec2& high) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
            scene::Vertex vertex;
            vertex.position = glm::vec3(200 * corner.x - 100, y, 200 * corner.y - 100);
            vertex.normal = {0, side, 0};
            vertex.uv = glm::mix(low, high, corner);
            mesh.vertices.push_back(vertex);
        }
        const std::array<std::uint32_t, 6> up{0, 2, 1, 0, 3, 2};
        for (std::size_t i = 0; i < 6; ++i) {
            mesh.indices.push_back(first + up[side > 0 ? i : 5 - i]);
        }
    };
    addFace(0, 1, {0.125f, 0.125f}, {0.5f, 0.875f});
    addFace(-2, -1, {0.75f, 0.125f}, {0.875f, 0.875f});
    return sceneOf(mesh);
}

TEST(Atlas, CoversWhatTheTrianglesCover) {
    const scene::Scene scene = mappedSlab();
    const Atlas atlas = bake::makeAtlas(scene, 0, 32, 16, "test");
    EXPECT_EQ(atlas.shared, 0u);
    trace::Geometry geometry(scene);
    std::size_t upper = 0;
    for (std::size_t i = 0; i < atlas.texels.size(); ++i) {
        const glm::dvec2 middle((atlas.texels[i] % 32 + 0.5) / 32, (atlas.texels[i] / 32 + 0.5) / 16);
        const trace::Place place = geometry.placeOf(atlas.places[i]);
        const bool inside = middle.x > 0.125 && middle.x < 0.5 && middle.y > 0.125 && middle.y < 0.875;
        if (inside) {
            ++upper;
            EXPECT_NEAR(place.position.x, 200 * (middle.x - 0.125) / 0.375 - 100, 1e-3);
            EXPECT_NEAR(place.position.z, 200 * (middle.y - 0.125) / 0.75 - 100, 1e-3);
            EXPECT_NEAR(place.position.y, 0, 1e-6);
        }
    }
    EXPECT_EQ(upper, 12u * 12u);
}

TEST(Atlas, PadsWithTheNearestTexel) {
    const Atlas atlas = bake::makeAtlas(mappedSlab(), 0, 32, 16, "test");
    std::vector<float> values;
    for (const trace::Hit& place : atlas.places) {
        values.push_back(place.triangle < 2 ? 1.0f : 2.0f); // the upper side's triangles come first
    }
    const std::vector<float> picture = bake::padded(atlas, values);
    const auto at = [&](std::size_t x, std::size_t y) { return picture[y * 32 + x]; };
    EXPECT_EQ(at(0, 0), 1);
    EXPECT_EQ(at(17, 8), 1);
    EXPECT_EQ(at(22, 8), 2);
    EXPECT_EQ(at(25, 15), 2);
    EXPECT_EQ(std::ranges::count(picture, 1.0f) + std::ranges::count(picture, 2.0f), 32 * 16);
}

TEST(Atlas, TellsOverlapsAndRefusesWhatRunsTooFar) {
    scene::Scene scene = mappedSlab();
    for (std::size_t i = 4; i < 8; ++i) { // the lower side over the upper one, one picture further
        scene.meshes[0].vertices[i].uv = scene.meshes[0].vertices[i - 4].uv + glm::vec2(1, 0);
    }
    const Atlas atlas = bake::makeAtlas(scene, 0, 32, 16, "test");
    EXPECT_GT(atlas.shared, 100u);
    scene.meshes[0].vertices[5].uv.x = 40;
    EXPECT_THROW(bake::makeAtlas(scene, 0, 32, 16, "test"), scene::SceneError);
    for (scene::Vertex& vertex : scene.meshes[0].vertices) {
        vertex.uv = {0, 0};
    }
    EXPECT_TRUE(bake::makeAtlas(scene, 0, 32, 16, "test").places.empty());
}

class ThicknessBakeTest : public testing::Test {
protected:
    /// Stops after that many looks.
    ThicknessState bake(unsigned threads, int looks = std::numeric_limits<int>::max(), ThicknessState from = {}) const {
        ThicknessBake bake(scene_, bake::makeVertexPlaces(scene_, scene::none).places, skinLaw(),
                           {samples_, 3, threads});
        bake.resume(std::move(from));
        bake.run([&] { return --looks > 0; });
        return bake.state();
    }

    const scene::Scene scene_ = sceneOf(ball(4, 24));
    const std::uint32_t samples_ = 128; // so that one slice is not all
};

TEST_F(ThicknessBakeTest, DoesNotDependOnThreadsOrInterruptions) {
    const ThicknessState two = bake(2);
    ASSERT_GT(two.millimetres.size(), 512u);
    EXPECT_EQ(bake(1).millimetres, two.millimetres);
    EXPECT_EQ(bake(5).millimetres, two.millimetres);
    const ThicknessState begun = bake(2, 1);
    ASSERT_LT(begun.millimetres.size(), two.millimetres.size());
    const tests::TemporaryFolder folder;
    const trace::Identity identity{{"scene", "a"}, {"rays", "128"}};
    const std::filesystem::path file = folder.path / "t.checkpoint";
    bake::saveThickness(file, identity, begun);
    const ThicknessState resumed = bake(2, 1 << 30, bake::loadThickness(file, identity, two.millimetres.size()));
    EXPECT_EQ(resumed.millimetres, two.millimetres);
    EXPECT_EQ(resumed.escaped, two.escaped);
    EXPECT_THROW(bake::loadThickness(file, {{"scene", "b"}, {"rays", "128"}}, two.millimetres.size()), FileError);
    EXPECT_THROW(bake::loadThickness(file, identity, 1), FileError);
}

TEST_F(ThicknessBakeTest, WarnsOfOpenMeshesOnly) {
    EXPECT_TRUE(ThicknessBake(scene_, {}, ThicknessLaw(), {}).warnings().empty());
    const scene::Scene sheet = sceneOf(rectangle({-5, -5}, {5, 5}, 0));
    ThicknessBake bake(sheet, bake::makeVertexPlaces(sheet, scene::none).places, ThicknessLaw(), {8, 1, 1});
    bake.run([] { return true; });
    ASSERT_EQ(bake.warnings().size(), 2u);
    EXPECT_NE(bake.warnings()[0].find("4 open edges"), std::string::npos);
    EXPECT_NE(bake.warnings()[1].find("100.0 %"), std::string::npos);
}

// What a PNG keeps is what a renderer reads from it: white times the texel.
TEST(ThicknessFiles, PictureGivesTheThicknessBack) {
    const Atlas atlas = bake::makeAtlas(mappedSlab(), 0, 32, 16, "test");
    std::vector<float> millimetres(atlas.places.size());
    std::iota(millimetres.begin(), millimetres.end(), 0.0f);
    const double white = millimetres.back();
    const tests::TemporaryFolder folder;
    bake::writeThicknessPng(folder.path / "t.png", atlas, millimetres, white);
    bake::writeThicknessExr(folder.path / "t.exr", atlas, millimetres);
    const nacre::Image png = readImage(folder.path / "t.png");
    const nacre::Image exr = readImage(folder.path / "t.exr");
    const std::size_t thickness = findChannel(exr, "MM").value();
    const std::size_t coverage = findChannel(exr, "A").value();
    for (std::size_t i = 0; i < atlas.texels.size(); ++i) {
        const std::uint32_t x = atlas.texels[i] % 32;
        const std::uint32_t y = atlas.texels[i] / 32;
        EXPECT_NEAR(png.at(x, y)[0] * white, millimetres[i], 0.5 * white / 255 + 1e-4);
        EXPECT_EQ(exr.at(x, y)[thickness], millimetres[i]);
        EXPECT_EQ(exr.at(x, y)[coverage], 1);
    }
    EXPECT_EQ(exr.at(20, 8)[coverage], 0);
}

TEST(ThicknessFiles, MeshHasAValueForEachVertex) {
    const scene::Scene scene = sceneOf(box({-1, -1, -1}, {1, 1, 1}));
    const bake::VertexPlaces vertices = bake::makeVertexPlaces(scene, scene::none);
    const std::vector<float> millimetres(vertices.places.size(), 2.5f);
    const tests::TemporaryFolder folder;
    bake::writeThicknessPly(folder.path / "t.ply", scene, vertices, millimetres);
    const std::vector<std::uint8_t> bytes = readFile(folder.path / "t.ply");
    const std::string text(bytes.begin(), bytes.end());
    const std::size_t body = text.find("end_header\n") + 11;
    EXPECT_NE(text.find("element vertex " + std::to_string(millimetres.size())), std::string::npos);
    EXPECT_NE(text.find("element face 12"), std::string::npos);
    EXPECT_EQ(bytes.size(), body + millimetres.size() * 28 + 12 * 13);
    float thickness = 0;
    std::memcpy(&thickness, bytes.data() + body + 24, sizeof thickness);
    EXPECT_EQ(thickness, 2.5f);
}

} // namespace
