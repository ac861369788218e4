// Error against time, of every technique at every quality.
#include "app/bench/materials.hpp"
#include "app/bench/suites.hpp"
#include "app/bench/techniques.hpp"
#include "app/bench/views.hpp"

#include <algorithm>

namespace nacre::bench {
namespace {

constexpr Size fullSizes[] = {{1920, 1080}, {3840, 2160}};
constexpr Size quickSizes[] = {{320, 180}};
constexpr std::uint32_t quickShadowMapSize = 512;
constexpr std::size_t closeUpCount = 2;

} // namespace

Plan makeParetoPlan(const SuiteSettings& settings) {
    Plan plan{.suite = "pareto", .scene = settings.scene.empty() ? "gallery" : settings.scene.string()};
    const std::vector<Size> sizes = settings.quick ? std::vector<Size>(std::begin(quickSizes), std::end(quickSizes))
                                                   : std::vector<Size>(std::begin(fullSizes), std::end(fullSizes));
    const std::vector<std::shared_ptr<const View>> views = closeUps(makeViews(settings.scene).front, closeUpCount);
    for (const Size& size : sizes) {
        for (const auto& view : views) {
            Series series{.name = "pareto, " + view->name + ", " + std::to_string(size.height),
                          .variable = "quality",
                          .withError = true};
            for (Variant& variant : qualityVariants(*view, size)) {
                variant.effect.transmit = false;
                series.configurations.push_back({.technique = variant.technique,
                                                 .effect = variant.effect,
                                                 .view = view,
                                                 .size = size,
                                                 .shadowMapSize = settings.quick ? quickShadowMapSize : 2048,
                                                 .materials = view->scene->materials,
                                                 .value = variant.quality});
            }
            plan.series.push_back(std::move(series));
        }
    }
    return plan;
}

} // namespace nacre::bench
