// The viewer's loop without a window: it allocates nothing while something is dragged, and ends up where it was.
#include "nacre/presets.hpp"
#include "tests/gpu/support/recording_calls.hpp"
#include "tests/gpu/support/renderer_scenes.hpp"
#include "view/loop/headless.hpp"
#include "view/loop/picture_loop.hpp"
#include "view/loop/reference_task.hpp"
#include "view/model/edited_scene.hpp"
#include "view/model/inspection.hpp"
#include "view/model/material_structs.hpp"

#include "trace/geometry.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace nacre::tests {
namespace {

using view::PictureLoop;
using view::Step;

constexpr std::uint32_t side = 48;

/// A ball of the first preset over a ground without a material, a light in front of and one behind it.
scene::Scene ballScene() {
    scene::Scene scene = darkScene(3);
    scene.environment.intensity = 0.2f;
    scene.metersPerUnit = 0.02;
    scene.materials = {presets().front()};
    add(scene, square(4), glm::translate(glm::mat4(1), {0, 0, -0.6f}));
    add(scene, sphere(0.5f, 12)).material = 0;
    scene.lights = {directional({0.3f, -0.5f, -1}, 2), directional({0.1f, -0.2f, 1}, 2)};
    return scene;
}

view::LoopSettings smallLoop() {
    view::LoopSettings settings;
    settings.width = side;
    settings.height = side;
    settings.shadowMapSize = 64;
    settings.stillSamples = 4;
    settings.tolerableMilliseconds = 1e9;
    return settings;
}

void draw(PictureLoop& loop) {
    while (loop.step() == Step::Busy) {
        std::this_thread::yield();
    }
}

Image stillPicture(PictureLoop& loop) {
    while (!loop.isConverged()) {
        draw(loop);
    }
    return loop.read(0).shown;
}

/// One loop for all tests: a software device compiles its passes for seconds.
class ViewLoop : public RendererTest {
protected:
    static void SetUpTestSuite() {
        countCalls(device());
        scene_ = new scene::Scene(ballScene());
        loop_ = new PictureLoop(device(), *scene_, smallLoop());
    }
    static void TearDownTestSuite() {
        delete loop_;
        delete scene_;
    }

    static inline scene::Scene* scene_ = nullptr;
    static inline PictureLoop* loop_ = nullptr;
};

TEST_F(ViewLoop, DraggingASliderAllocatesNothingAndWaitsForNothing) {
    stillPicture(*loop_);
    // The coarser frame is made when something moves for the first time.
    loop_->setMoving(true);
    draw(*loop_);
    std::vector<Material> materials = scene_->materials;
    callCounts() = {};
    forbiddenCalls().clear();
    constexpr int frames = 200;
    for (int frame = 0; frame < frames; ++frame) {
        materials[0].scale = 1 + 0.01 * frame;
        loop_->setMoving(true);
        loop_->setMaterials(materials);
        draw(*loop_);
    }
    // Submissions are the loop's own, one a frame. It reads the times of a frame whose fence it has seen, without a
    // wait.
    std::erase_if(forbiddenCalls(),
                  [](const std::string& name) { return name == "vkQueueSubmit2" || name == "vkGetQueryPoolResults"; });
    EXPECT_EQ(forbiddenCalls(), std::vector<std::string>{});
    EXPECT_EQ(callCounts().allocations, 0);
    EXPECT_GE(loop_->framesFinished(), frames - 2u);
    loop_->setMoving(false);
    loop_->setMaterials(scene_->materials);
}

TEST_F(ViewLoop, WhatIsTakenBackGivesThePictureBackToTheLastBit) {
    const Image before = stillPicture(*loop_);
    std::vector<Material> materials = scene_->materials;
    materials[0].scale = 4;
    loop_->setMaterials(materials);
    const Image changed = stillPicture(*loop_);
    EXPECT_FALSE(changed == before);
    loop_->setMaterials(scene_->materials);
    EXPECT_TRUE(stillPicture(*loop_) == before);
}

TEST_F(ViewLoop, SamplesOfAStillPictureSmoothItsEdges) {
    loop_->setCamera(scene_->cameras[0]);
    draw(*loop_);
    const Image one = loop_->read(0).shown;
    EXPECT_EQ(loop_->samples(0), 1u);
    const Image all = stillPicture(*loop_);
    EXPECT_EQ(loop_->samples(0), smallLoop().stillSamples);
    EXPECT_FALSE(one == all);
}

TEST_F(ViewLoop, TheSecondSideIsAnotherEffectOfTheSameFrame) {
    view::SideSettings off;
    off.effect.scatter = off.effect.transmit = false;
    off.look.exposure = scene_->exposure;
    loop_->setSide(1, off);
    loop_->setShown({renderer::ShownSides::Both, 0.5f});
    const Image with = stillPicture(*loop_);
    const Image without = loop_->read(1).shown;
    EXPECT_EQ(loop_->samples(0), loop_->samples(1));
    EXPECT_FALSE(with == without);
    loop_->setShown({});
}

TEST_F(ViewLoop, AGivenPictureIsShownAsItIs) {
    Image grey = makeImage(side, side, {"R", "G", "B"});
    std::ranges::fill(grey.values, 0.25f);
    view::SideSettings given;
    given.look.image = renderer::ShownImage::Given;
    given.look.givenIsDisplayed = true;
    loop_->setGiven(grey);
    loop_->setSide(1, given);
    loop_->setShown({renderer::ShownSides::Both, 0.5f});
    stillPicture(*loop_);
    EXPECT_TRUE(loop_->read(1).shown == grey);
    loop_->setShown({});
}

TEST_F(ViewLoop, APictureOfAnotherSizeAndBackIsTheSame) {
    const Image before = stillPicture(*loop_);
    loop_->resize(32, 20);
    const Image other = stillPicture(*loop_);
    EXPECT_EQ(other.width, 32u);
    EXPECT_EQ(other.height, 20u);
    loop_->resize(side, side);
    EXPECT_TRUE(stillPicture(*loop_) == before);
}

TEST(ViewReference, ClosingWhileItRunsTakesLessThanASecond) {
    auto task = std::make_unique<view::ReferenceTask>(ballScene(), ballScene().cameras[0], side, side);
    while (task->version() == 0 && task->state().fault.empty()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(task->state().fault, "");
    EXPECT_GT(task->state().light.at(side / 2, side / 2)[0], 0);
    const auto begin = std::chrono::steady_clock::now();
    task.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

TEST(ViewInspection, SaysWhyThereIsNothing) {
    scene::Scene scene = ballScene();
    const trace::Geometry geometry(scene);
    view::EditedScene edited = view::editedOf(scene);
    const auto sentenceAt = [&](glm::dvec2 place, const renderer::EffectSettings& effect = {}) {
        const auto found = view::inspect(geometry, edited, scene.cameras[0], effect, place, 200, 200);
        return found ? found->sentence : std::string("nothing");
    };
    EXPECT_EQ(sentenceAt({0.5, 0.5}).rfind("It scatters: light travels", 0), 0u) << sentenceAt({0.5, 0.5});
    EXPECT_NE(sentenceAt({0.5, 0.5}, {.scatter = false}).find("scatter is off"), std::string::npos);
    EXPECT_NE(sentenceAt({0.5, 0.5}).find("is behind"), std::string::npos) << sentenceAt({0.5, 0.5});
    EXPECT_NE(sentenceAt({0.05, 0.05}).find("no subsurface material"), std::string::npos);
    edited.materials[0].material.strength = 0;
    edited.materials[0].material.translucency = 0;
    EXPECT_NE(sentenceAt({0.5, 0.5}).find("strength is 0"), std::string::npos);
    EXPECT_NE(sentenceAt({0.5, 0.5}).find("translucency is 0"), std::string::npos);
}

TEST(ViewLayers, AreAddedHiddenMovedAndRemoved) {
    view::EditedMaterial edited{presets().front(), {}};
    const std::vector<Layer> original = edited.material.layers;
    edited.hidden = {1};
    EXPECT_EQ(edited.drawn().layers.size(), original.size() - 1);
    view::moveLayer(edited, 1, 3);
    EXPECT_EQ(edited.hidden, std::set<std::size_t>{3});
    EXPECT_EQ(edited.material.layers[3], original[1]);
    EXPECT_TRUE(view::duplicateLayer(edited, 0));
    EXPECT_EQ(edited.hidden, std::set<std::size_t>{4});
    EXPECT_TRUE(view::removeLayer(edited, 4));
    EXPECT_TRUE(edited.hidden.empty());
    EXPECT_TRUE(view::addLayer(edited));
    EXPECT_EQ(findFault(edited.material), "");
    while (view::removeLayer(edited, 0)) {
    }
    EXPECT_EQ(edited.material.layers.size(), 1u);
}

TEST(ViewLayers, OfAMeanFreePathAreItsProfileAtAnyScale) {
    view::EditedMaterial edited{*findPreset("skin-burley"), {}};
    edited.material.scale = 3;
    const double before = makeProfile(edited.material)->rmsRadius(0);
    view::layersOf(edited);
    EXPECT_EQ(findFault(edited.material), "");
    EXPECT_NEAR(makeProfile(edited.material)->rmsRadius(0) / before, 1, 0.03);
}

TEST(ViewStructs, NameEveryLayer) {
    const std::string text = view::structsOf(presets().front());
    EXPECT_NE(text.find("static const NacreLayer skin_layers[] = {\n"), std::string::npos);
    EXPECT_NE(text.find(".layerCount = 6,"), std::string::npos);
    EXPECT_NE(text.find(".variance = 7.4"), std::string::npos);
}

} // namespace
} // namespace nacre::tests
