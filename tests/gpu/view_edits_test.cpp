// What the viewer's window edits, as values: scenes, layers, lights; and what it says of them.
#include "view/model/edited_scene.hpp"

#include "nacre/presets.hpp"
#include "tests/gpu/support/view_scene.hpp"
#include "trace/geometry.hpp"
#include "view/model/edited_file.hpp"
#include "view/model/inspection.hpp"
#include "view/model/light_handles.hpp"
#include "view/model/material_structs.hpp"
#include "view/model/recipes.hpp"
#include "view/model/window_colors.hpp"

namespace nacre::tests {
namespace {

TEST(ViewEdits, AreKeptWhole) {
    scene::Scene scene = ballScene();
    scene.environment.file = "h\xf6hle.hdr";
    const view::EditedScene base = view::editedOf(scene);
    view::EditedScene edited = base;
    edited.materials[0].hidden = {2};
    edited.materials[0].material.layers[1].variance = 0.1234;
    edited.surfaces[1].roughness = 0.3f;
    edited.surfaces[1].material = scene::none;
    edited.lights.pop_back();
    edited.lights[0].intensity = 0.7f;
    edited.lights[0].name = "l\xe4mp";
    edited.exposureStops = 1.5f;
    edited.environmentRotation = 0.25f;
    const std::string text = view::formatEdited(edited);
    EXPECT_NE(text, view::formatEdited(base));
    const view::EditedScene read = view::parseEdited(text, "kept", base);
    EXPECT_EQ(read.materials, edited.materials);
    EXPECT_EQ(read.surfaces[1].material, scene::none);
    EXPECT_EQ(read.lights.size(), 1u);
    EXPECT_EQ(read.lights[0].intensity, 0.7f);
    EXPECT_EQ(read.environmentRotation, 0.25f);
    EXPECT_EQ(read.environmentFile, base.environmentFile); // of a name that is not UTF-8
    EXPECT_EQ(read.lights[0].name, "l\ufffdmp");
    view::EditedScene other = base;
    other.materials.clear();
    EXPECT_THROW(static_cast<void>(view::parseEdited(text, "kept", other)), FileError);
    EXPECT_THROW(static_cast<void>(view::parseEdited("{}", "kept", base)), FileError);
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

TEST(ViewRecipes, ASlabsMelaninMakesItSkin) {
    std::vector<Slab> slabs = view::skinSlabs({});
    const Material before = view::mixSlabs(presets().front(), slabs);
    for (const view::Parameter<Slab>& parameter : view::slabParameters()) {
        if (parameter.name == std::string("slab.melanin")) {
            parameter.set(slabs[0], 0.4);
        }
    }
    const Material dark = view::mixSlabs(presets().front(), slabs);
    EXPECT_EQ(findFault(dark), "");
    EXPECT_EQ(dark.slabs, slabs);
    EXPECT_LT(dark.albedo[0], 0.7 * before.albedo[0]);
}

TEST(ViewStructs, NameEveryLayer) {
    const std::string text = view::structsOf(presets().front());
    EXPECT_NE(text.find("static const NacreLayer skin_layers[] = {\n"), std::string::npos);
    EXPECT_NE(text.find(".layerCount = 6,"), std::string::npos);
    EXPECT_NE(text.find(".variance = 7.4"), std::string::npos);
}

TEST(ViewHandles, FollowTheMouse) {
    scene::Camera camera;
    camera.position = {1, 2, 5};
    camera.target = {0.5f, 0, 0};
    constexpr float aspect = 1.5f;
    for (const scene::LightKind kind :
         {scene::LightKind::Directional, scene::LightKind::Spot, scene::LightKind::Point}) {
        const scene::Light light = view::newLight(kind, camera, 1);
        const std::vector<scene::Light> one{light};
        ASSERT_EQ(view::lightHandles(one, camera, aspect).size(), 1u);
        for (const bool behind : {false, true}) {
            const glm::vec2 place(0.45f, 0.6f);
            const auto dragged = view::draggedLight(light, camera, aspect, place, view::LightDrag::Move, behind);
            ASSERT_TRUE(dragged);
            const view::LightHandle handle = view::lightHandles(std::vector{*dragged}, camera, aspect).at(0);
            EXPECT_NEAR(glm::distance(handle.place, place), 0, 1e-4f);
            EXPECT_TRUE(kind != scene::LightKind::Directional || handle.behind == behind);
        }
    }
    const scene::Light sun = view::newLight(scene::LightKind::Directional, camera, 1);
    EXPECT_FALSE(view::draggedLight(sun, camera, aspect, {0.99f, 0.5f}, view::LightDrag::Move, false));
    const scene::Light spot = view::newLight(scene::LightKind::Spot, camera, 1);
    const auto aimed = view::draggedLight(spot, camera, aspect, {0.5f, 0.5f}, view::LightDrag::Aim, false);
    EXPECT_NEAR(glm::distance(aimed->direction, glm::normalize(camera.target - spot.position)), 0, 1e-5f);
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

TEST(ViewColors, AreToldApart) {
    for (const view::WindowColors& colors : {view::darkColors, view::lightColors}) {
        for (const view::ShownColor& ground :
             {colors.window, colors.base, colors.alternateBase, colors.button, colors.toolTip}) {
            EXPECT_GE(view::contrast(colors.text, ground), 4.5);
            EXPECT_GE(view::contrast(colors.faint, ground), 3);
        }
        EXPECT_GE(view::contrast(colors.highlightedText, colors.highlight), 4.5);
        EXPECT_GE(view::contrast(colors.link, colors.window), 4.5);
    }
    EXPECT_NEAR(view::contrast({0, 0, 0}, {255, 255, 255}), 21, 1e-9);
}

} // namespace
} // namespace nacre::tests
