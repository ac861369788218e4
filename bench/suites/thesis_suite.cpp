// Experiments 1, 2 and 3 of the thesis, chapter 4.5.
#include "bench/suites/suite_materials.hpp"
#include "bench/suites/suite_views.hpp"
#include "bench/suites/suites.hpp"
#include "bench/suites/technique_variants.hpp"
#include "bench/suites/thesis_constants.hpp"
#include "nacre/presets.hpp"
#include "scene/import.hpp"
#include "scene/surface_material.hpp"

#include <algorithm>

namespace nacre::bench {
namespace {

constexpr Size fullSizes[] = {{1280, 720}, {1920, 1080}};
constexpr Size quickSizes[] = {{256, 144}, {384, 216}};
constexpr std::uint32_t quickShadowMapSize = 512;
constexpr Size pictureSize = {800, 450};
constexpr Size quickPictureSize = {640, 360};

// Chapter 4.5.1 to 4.5.3.
constexpr int layersOfExperiment1[] = {1, 3, 6, 10};
constexpr std::uint32_t radiusOfExperiment1 = 5; // 11 weights
constexpr int firstRadius = 3;
constexpr int mostLayers = 11;
constexpr int quickStep = 5; // between radii, and between layers of experiment 3

constexpr renderer::EffectSettings off{.scatter = false, .transmit = false};

class ThesisPlan {
public:
    explicit ThesisPlan(const SuiteSettings& settings)
        : settings_(settings), views_(makeViews(settings.scene)), skin_(*findPreset("skin")) {}

    Plan make() {
        plan_.suite = "thesis";
        plan_.scene = settings_.scene.empty() ? "gallery" : settings_.scene.string();
        addExperiment1("front", views_.front);
        addExperiment1("back", views_.back);
        addExperiment2();
        addExperiment3();
        addPictures();
        return std::move(plan_);
    }

private:
    std::vector<Size> sizes() const {
        return settings_.quick ? std::vector<Size>(std::begin(quickSizes), std::end(quickSizes))
                               : std::vector<Size>(std::begin(fullSizes), std::end(fullSizes));
    }

    int step() const { return settings_.quick ? quickStep : 1; }

    Configuration configure(const Variant& variant, const std::shared_ptr<const View>& view, const Size& size,
                            std::vector<Material> materials, double value) const {
        return {.technique = variant.technique,
                .effect = variant.effect,
                .view = view,
                .size = size,
                .shadowMapSize = settings_.quick ? quickShadowMapSize : thesis::shadowMapSize,
                .materials = std::move(materials),
                .value = value};
    }

    std::vector<Material> sceneMaterials(int layers) const {
        std::vector<Material> materials = views_.front->scene->materials;
        for (Material& material : materials) {
            material = withLayers(material, static_cast<std::size_t>(layers));
        }
        return materials;
    }

    // "The same material was used throughout this test" (chapter 4.5.2): one for all bodies, so one pass pair.
    std::shared_ptr<const View> withOneMaterial(const View& view) const {
        auto scene = std::make_shared<scene::Scene>(*view.scene);
        scene::assignMaterial(*scene, skin_);
        return std::make_shared<View>(View{view.name + ", one material", scene, view.camera});
    }

    void addExperiment1(const std::string& side, const std::shared_ptr<const View>& view) {
        Series& series = plan_.series.emplace_back(Series{"experiment 1, " + side, "layers", "", {}});
        for (const Size& size : sizes()) {
            for (const Variant& variant : scatterVariants(*view, size, radiusOfExperiment1)) {
                for (const int layers : layersOfExperiment1) {
                    series.configurations.push_back(configure(variant, view, size, sceneMaterials(layers), layers));
                }
            }
        }
    }

    void addExperiment2() {
        Series& series = plan_.series.emplace_back(Series{"experiment 2", "radius", "texels", {}});
        const std::shared_ptr<const View> view = withOneMaterial(*views_.front);
        for (const Size& size : sizes()) {
            const double millimeters = 1 / pixelsPerMillimeter(*view, size);
            for (int radius = firstRadius; radius <= thesis::largestRadius; radius += step()) {
                const Material material = withKernelRadius(skin_, radius * millimeters);
                for (Variant& variant : scatterVariants(*view, size, static_cast<std::uint32_t>(radius))) {
                    variant.effect.transmit = false;
                    series.configurations.push_back(configure(variant, view, size, {material}, radius));
                }
            }
        }
    }

    void addExperiment3() {
        Series& series = plan_.series.emplace_back(Series{"experiment 3", "layers", "", {}});
        for (const Size& size : sizes()) {
            for (const Variant& variant : transmitVariants()) {
                for (int layers = 1; layers <= mostLayers; layers += step()) {
                    series.configurations.push_back(
                        configure(variant, views_.back, size, sceneMaterials(layers), layers));
                }
            }
        }
    }

    void addPicture(const std::string& series, const std::string& title, const std::string& name,
                    const std::shared_ptr<const View>& view, const renderer::EffectSettings& on) {
        plan_.pictures.push_back({.series = series,
                                  .title = title,
                                  .name = name,
                                  .view = view,
                                  .size = settings_.quick ? quickPictureSize : pictureSize,
                                  .materials = view->scene->materials,
                                  .before = off,
                                  .beforeText = "effect off",
                                  .after = on,
                                  .afterText = "effect on"});
    }

    void addPictures() {
        addPicture("experiment 1, front", "As figure 4.2a: front-lit", "figure-4.2a", views_.front, {});
        addPicture("experiment 1, back", "As figure 4.2b: back-lit", "figure-4.2b", views_.back, {});
        for (const auto& view : closeUps(views_.front, 2)) {
            if (view != views_.front) {
                addPicture("experiment 2", "As figure 4.4: " + view->name,
                           "figure-4.4-" + std::to_string(plan_.pictures.size()), view, {.transmit = false});
            }
        }
        for (const auto& view : closeUps(views_.back, 2)) {
            addPicture("experiment 3", "As figure 4.6: " + view->name,
                       "figure-4.6-" + std::to_string(plan_.pictures.size()), view, {.scatter = false});
        }
    }

    SuiteSettings settings_;
    Views views_;
    Material skin_;
    Plan plan_;
};

} // namespace

Plan makeThesisPlan(const SuiteSettings& settings) {
    return ThesisPlan(settings).make();
}

} // namespace nacre::bench
