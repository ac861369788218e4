#include "bench/suites/technique_variants.hpp"

#include <cmath>

namespace nacre::bench {
namespace {

using renderer::EffectSettings;

constexpr std::uint32_t thesisRadii[] = {3, 5, 8, 12, 16};
constexpr std::uint32_t burleyBudgets[] = {8, 16, 32, 64, 128};
constexpr double pixelShares[] = {0.5, 0.75, 1};

EffectSettings thesisSettings(const View& view, const Size& size, std::uint32_t radius, bool baked) {
    return {.technique = NACRE_TECHNIQUE_THESIS,
            .baselines = {.thesisRadius = radius,
                          .thesisStrength = thesisStrength(view, size, radius),
                          .thesisBakedKernel = baked}};
}

// The size of the same shape with `share` of the pixels.
Size shrunk(const Size& size, double share) {
    const auto side = [share](std::uint32_t length) {
        return static_cast<std::uint32_t>(std::lround(length * std::sqrt(share)));
    };
    return {side(size.width), side(size.height)};
}

} // namespace

std::vector<Variant> scatterVariants(const View& view, const Size& size, std::uint32_t radius) {
    EffectSettings thesis = thesisSettings(view, size, radius, false);
    EffectSettings baked = thesisSettings(view, size, radius, true);
    thesis.baselines.thesisTransmittance = baked.baselines.thesisTransmittance = VK_TRUE;
    return {{"thesis", thesis},
            {"thesis-baked", baked},
            {"separable", {.technique = NACRE_TECHNIQUE_SEPARABLE}},
            {"burley", {.technique = NACRE_TECHNIQUE_BURLEY}},
            {"bank", {.technique = NACRE_TECHNIQUE_BANK}}};
}

std::vector<Variant> transmitVariants() {
    return {{"thesis", {.scatter = false, .baselines = {.thesisTransmittance = VK_TRUE}}},
            {"slab", {.scatter = false}}};
}

std::vector<QualityVariant> qualityVariants(const View& view, const Size& size) {
    std::vector<QualityVariant> variants;
    const auto add = [&](const char* name, const EffectSettings& effect, double quality, const char* unit,
                         const Size& pictureSize) {
        variants.push_back({{name, effect}, quality, unit, pictureSize});
    };
    for (const std::uint32_t radius : thesisRadii) {
        add("thesis", thesisSettings(view, size, radius, false), radius, "texels", size);
    }
    for (const std::uint32_t budget : burleyBudgets) {
        add("burley", {.technique = NACRE_TECHNIQUE_BURLEY, .burleySampleBudget = budget}, budget, "samples", size);
    }
    for (const auto& [name, technique] :
         {std::pair{"separable", NACRE_TECHNIQUE_SEPARABLE}, std::pair{"bank", NACRE_TECHNIQUE_BANK},
          std::pair{"bank-surfaces", NACRE_TECHNIQUE_BANK_SURFACES}}) {
        for (const double share : pixelShares) {
            add(name, {.technique = technique}, 100 * share, "% of the pixels", shrunk(size, share));
        }
    }
    return variants;
}

} // namespace nacre::bench
