// Time against each quantity that it could depend on.
#include "bench/results/series_fits.hpp"
#include "bench/suites/slab.hpp"
#include "bench/suites/suite_materials.hpp"
#include "bench/suites/suite_views.hpp"
#include "bench/suites/suites.hpp"
#include "bench/suites/technique_variants.hpp"
#include "nacre/presets.hpp"

namespace nacre::bench {
namespace {

/// What the slab's picture has where the series does not vary it.
constexpr double usualFootprint = 12;     // px
constexpr std::uint32_t usualRadius = 12; // texels

struct Values {
    std::vector<Size> sizes; ///< of the resolution series
    Size size;               ///< of all others
    std::vector<double> coverages, footprints;
    std::uint32_t columns, rows; // of patches in the series of materials, so that borders between these stay the same
    std::vector<std::uint32_t> materials, layers, lights, triangles;
    std::uint32_t shadowMapSize;
};

const Values fullValues{.sizes = {{1280, 720}, {1920, 1080}, {2560, 1440}, {3840, 2160}, {5120, 2880}, {7680, 4320}},
                        .size = {1920, 1080},
                        .coverages = {0.05, 0.1, 0.25, 0.5, 0.75, 1},
                        .footprints = {1, 2, 4, 8, 16, 32, 64, 128},
                        .columns = 47,
                        .rows = 26,
                        .materials = {1, 2, 4, 10, 32, 100, 320, 1000},
                        .layers = {1, 2, 4, 6, 10, 16, 24, 32},
                        .lights = {1, 2, 4, 6, 8, 12, 16},
                        .triangles = {10'000, 30'000, 100'000, 300'000, 1'000'000, 3'000'000, 10'000'000},
                        .shadowMapSize = 2048};

const Values quickValues{.sizes = {{160, 90}, {320, 180}, {480, 270}},
                         .size = {320, 180},
                         .coverages = {0.05, 0.5, 1},
                         .footprints = {1, 8, 64},
                         .columns = 9,
                         .rows = 8,
                         .materials = {1, 8, 64},
                         .layers = {1, 6, 32},
                         .lights = {1, 2, 4},
                         .triangles = {10'000, 50'000, 250'000},
                         .shadowMapSize = 256};

class SweepPlan {
public:
    explicit SweepPlan(const SuiteSettings& settings)
        : settings_(settings), values_(settings.quick ? quickValues : fullValues), skin_(*findPreset("skin")) {}

    Plan make() {
        plan_.suite = "sweep";
        plan_.scene = "slab, and " + (settings_.scene.empty() ? "gallery" : settings_.scene.string());
        addResolutions();
        addCoverages();
        addFootprints();
        addMaterials();
        addLayers();
        addLights();
        addTriangles();
        return std::move(plan_);
    }

private:
    Material skinOf(double footprint) const {
        return withRmsRadius(skin_, footprint / pixelsPerMillimeter(*slab_, values_.size));
    }

    void add(Series& series, const std::shared_ptr<const View>& view, const Size& size,
             const std::vector<Material>& materials, double value) {
        for (const Variant& variant : scatterVariants(*view, size, usualRadius)) {
            series.configurations.push_back({.technique = variant.technique,
                                             .effect = variant.effect,
                                             .view = view,
                                             .size = size,
                                             .shadowMapSize = values_.shadowMapSize,
                                             .materials = materials,
                                             .value = value});
        }
    }

    void addResolutions() {
        Series& series = plan_.series.emplace_back(Series{resolutionVariable, resolutionVariable, "Mpx", {}});
        const std::shared_ptr<const View> view = makeView(settings_.scene, "both");
        for (const Size& size : values_.sizes) {
            add(series, view, size, view->scene->materials, 1e-6 * size.width * size.height);
        }
    }

    void addCoverages() {
        Series& series = plan_.series.emplace_back(Series{"coverage", "coverage", "%", {}});
        for (const double coverage : values_.coverages) {
            const auto view = makeSlab({.coverage = coverage});
            add(series, view, values_.size, {skinOf(usualFootprint)}, 100 * coverage);
        }
    }

    void addFootprints() {
        Series& series = plan_.series.emplace_back(Series{"footprint", "footprint", "px", {}});
        for (const double footprint : values_.footprints) {
            add(series, slab_, values_.size, {skinOf(footprint)}, footprint);
        }
    }

    void addMaterials() {
        Series& series = plan_.series.emplace_back(Series{"materials", "materials", "", {}});
        for (const std::uint32_t count : values_.materials) {
            const auto view = makeSlab({.columns = values_.columns, .rows = values_.rows, .materials = count});
            add(series, view, values_.size, view->scene->materials, count);
        }
    }

    void addLayers() {
        Series& series = plan_.series.emplace_back(Series{"layers", "layers", "", {}});
        for (const std::uint32_t count : values_.layers) {
            add(series, slab_, values_.size, {withLayers(skinOf(usualFootprint), count)}, count);
        }
    }

    void addLights() {
        Series& series = plan_.series.emplace_back(Series{"lights", "lights", "", {}});
        for (const std::uint32_t count : values_.lights) {
            const auto view = makeSlab({.lights = count});
            add(series, view, values_.size, {skinOf(usualFootprint)}, count);
        }
    }

    void addTriangles() {
        Series& series = plan_.series.emplace_back(Series{"triangles", "triangles", "Mtriangles", {}});
        for (const std::uint32_t count : values_.triangles) {
            const auto view = makeSlab({.triangles = count});
            add(series, view, values_.size, {skinOf(usualFootprint)}, 1e-6 * count);
        }
    }

    SuiteSettings settings_;
    const Values& values_;
    Material skin_;
    std::shared_ptr<const View> slab_ = makeSlab({});
    Plan plan_;
};

} // namespace

Plan makeSweepPlan(const SuiteSettings& settings) {
    return SweepPlan(settings).make();
}

} // namespace nacre::bench
