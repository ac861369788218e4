#include "bench/suites/technique_variants.hpp"

#include "bench/techniques.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace nacre::bench {
namespace {

using renderer::EffectSettings;

/// What a technique that has a setting of its own gives up for time. The others give up pixels.
struct QualitySetting {
    NacreTechnique technique;
    const char* unit;
    std::array<std::uint32_t, 5> values;
    EffectSettings (*settings)(const View& view, const Size& size, std::uint32_t value);
};

EffectSettings thesisSettings(const View& view, const Size& size, std::uint32_t radius) {
    return {.technique = NACRE_TECHNIQUE_THESIS,
            .baselines = {.thesisRadius = radius, .thesisStrength = thesisStrength(view, size, radius)}};
}

EffectSettings burleySettings(const View&, const Size&, std::uint32_t budget) {
    return {.technique = NACRE_TECHNIQUE_BURLEY, .burleySampleBudget = budget};
}

constexpr std::array qualitySettings{
    QualitySetting{NACRE_TECHNIQUE_THESIS, "texels", {3, 5, 8, 12, 16}, thesisSettings},
    QualitySetting{NACRE_TECHNIQUE_BURLEY, "samples", {8, 16, 32, 64, 128}, burleySettings},
};
constexpr double pixelShares[] = {0.5, 0.75, 1};

// The size of the same shape with `share` of the pixels.
Size shrunk(const Size& size, double share) {
    const auto side = [share](std::uint32_t length) {
        return static_cast<std::uint32_t>(std::lround(length * std::sqrt(share)));
    };
    return {side(size.width), side(size.height)};
}

std::vector<Variant> thesisVariants(const View& view, const Size& size, std::uint32_t radius) {
    EffectSettings thesis = thesisSettings(view, size, radius);
    thesis.baselines.thesisTransmittance = VK_TRUE;
    EffectSettings baked = thesis;
    baked.baselines.thesisBakedKernel = VK_TRUE;
    return {{"thesis", thesis}, {"thesis-baked", baked}};
}

} // namespace

std::vector<Variant> scatterVariants(const View& view, const Size& size, std::uint32_t radius) {
    std::vector<Variant> variants;
    for (const NacreTechnique technique : realTimeTechniques()) {
        if (technique == NACRE_TECHNIQUE_THESIS) {
            std::ranges::move(thesisVariants(view, size, radius), std::back_inserter(variants));
        } else if (technique != NACRE_TECHNIQUE_BANK_SURFACES) {
            variants.push_back({nacreTechniqueString(technique), {.technique = technique}});
        }
    }
    return variants;
}

std::vector<Variant> transmitVariants() {
    return {{"thesis", {.scatter = false, .baselines = {.thesisTransmittance = VK_TRUE}}},
            {"slab", {.scatter = false}}};
}

std::vector<QualityVariant> qualityVariants(const View& view, const Size& size) {
    std::vector<QualityVariant> variants;
    const auto add = [&](const EffectSettings& effect, double quality, const char* unit, const Size& pictureSize) {
        variants.push_back({{nacreTechniqueString(effect.technique), effect}, quality, unit, pictureSize});
    };
    for (const NacreTechnique technique : realTimeTechniques()) {
        const auto own = std::ranges::find(qualitySettings, technique, &QualitySetting::technique);
        if (own != qualitySettings.end()) {
            for (const std::uint32_t value : own->values) {
                add(own->settings(view, size, value), value, own->unit, size);
            }
            continue;
        }
        for (const double share : pixelShares) {
            add({.technique = technique}, 100 * share, "% of the pixels", shrunk(size, share));
        }
    }
    return variants;
}

} // namespace nacre::bench
