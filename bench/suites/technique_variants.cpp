#include "bench/suites/technique_variants.hpp"

#include <cmath>

namespace nacre::bench {
namespace {

using renderer::EffectSettings;
using renderer::Technique;

constexpr std::uint32_t thesisRadii[] = {3, 5, 8, 12, 16};
constexpr std::uint32_t burleyBudgets[] = {8, 16, 32, 64, 128};
constexpr double pixelShares[] = {0.5, 0.75, 1};

EffectSettings thesisSettings(const View& view, const Size& size, std::uint32_t radius, bool baked) {
    return {.technique = Technique::Thesis,
            .thesisRadius = radius,
            .thesisStrength = thesisStrength(view, size, radius),
            .thesisBakedKernel = baked};
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
    thesis.thesisTransmittance = baked.thesisTransmittance = true;
    return {{"thesis", thesis},
            {"thesis-baked", baked},
            {"separable", {.technique = Technique::Separable}},
            {"burley", {.technique = Technique::Burley}},
            {"bank", {.technique = Technique::Bank}}};
}

std::vector<Variant> transmitVariants() {
    return {{"thesis", {.scatter = false, .thesisTransmittance = true}}, {"slab", {.scatter = false}}};
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
        add("burley", {.technique = Technique::Burley, .burleySampleBudget = budget}, budget, "samples", size);
    }
    for (const auto& [name, technique] :
         {std::pair{"separable", Technique::Separable}, std::pair{"bank", Technique::Bank},
          std::pair{"bank-surfaces", Technique::BankSurfaces}}) {
        for (const double share : pixelShares) {
            add(name, {.technique = technique}, 100 * share, "% of the pixels", shrunk(size, share));
        }
    }
    return variants;
}

} // namespace nacre::bench
