// Error against time, of every technique at every quality.
#include "bench/report/report_text.hpp"
#include "bench/suites/suite_views.hpp"
#include "bench/suites/suites.hpp"
#include "bench/suites/technique_variants.hpp"

#include <span>

namespace nacre::bench {
namespace {

constexpr Size fullSizes[] = {{1920, 1080}, {3840, 2160}};
constexpr Size quickSizes[] = {{128, 72}};
constexpr double fullScales[] = {0.5, 1, 2};
constexpr double quickScales[] = {1};
constexpr std::uint32_t fullShadowMapSize = 2048;
constexpr std::uint32_t quickShadowMapSize = 512;
constexpr std::size_t closeUpCount = 2;
constexpr Size pictureSize = {800, 450};
constexpr Size quickPictureSize = {128, 72};

// The view's materials, `scale` times as wide.
std::vector<Material> scaled(const View& view, double scale) {
    std::vector<Material> materials = view.scene->materials;
    for (Material& material : materials) {
        material.scale *= scale;
    }
    return materials;
}

Series makeSeries(const std::shared_ptr<const View>& view, const Size& size, double scale, bool quick) {
    const std::vector<Material> materials = scaled(*view, scale);
    Series series{.name = "pareto, " + view->name + ", " + std::to_string(size.height) + ", " +
                          formatNumber(footprint(*view, size, materials)) + " px",
                  .variable = "quality",
                  .errorAt = size};
    for (QualityVariant& quality : qualityVariants(*view, size)) {
        quality.variant.effect.transmit = false;
        series.configurations.push_back({.technique = quality.variant.technique,
                                         .effect = quality.variant.effect,
                                         .view = view,
                                         .size = quality.size,
                                         .shadowMapSize = quick ? quickShadowMapSize : fullShadowMapSize,
                                         .materials = materials,
                                         .value = quality.quality,
                                         .unit = quality.unit});
    }
    return series;
}

Picture makePicture(const std::shared_ptr<const View>& view, std::size_t number, bool quick) {
    return {.series = "pareto",
            .title = view->name,
            .name = "view-" + std::to_string(number),
            .view = view,
            .size = quick ? quickPictureSize : pictureSize,
            .materials = view->scene->materials,
            .before = {.technique = NACRE_TECHNIQUE_BRUTE},
            .beforeText = "brute",
            .after = {.technique = NACRE_TECHNIQUE_BANK},
            .afterText = "bank"};
}

} // namespace

Plan makeParetoPlan(const SuiteSettings& settings) {
    Plan plan{.suite = "pareto", .scene = settings.scene.empty() ? "gallery" : settings.scene.string()};
    const std::span<const Size> sizes = settings.quick ? std::span<const Size>(quickSizes) : fullSizes;
    const std::span<const double> scales = settings.quick ? std::span<const double>(quickScales) : fullScales;
    const std::vector<std::shared_ptr<const View>> views = closeUps(makeView(settings.scene, "front"), closeUpCount);
    for (const Size& size : sizes) {
        for (const auto& view : views) {
            for (const double scale : scales) {
                plan.series.push_back(makeSeries(view, size, scale, settings.quick));
            }
        }
    }
    for (const auto& view : views) {
        plan.pictures.push_back(makePicture(view, plan.pictures.size() + 1, settings.quick));
    }
    return plan;
}

} // namespace nacre::bench
