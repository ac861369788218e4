#include "app/bench/techniques.hpp"

namespace nacre::bench {
namespace {

using renderer::EffectSettings;
using renderer::Technique;

constexpr std::uint32_t thesisRadii[] = {3, 5, 8, 12, 16};
constexpr std::uint32_t burleyBudgets[] = {8, 16, 32, 64, 128};

EffectSettings thesisSettings(const View& view, const Size& size, std::uint32_t radius, bool baked) {
    return {.technique = Technique::Thesis,
            .thesisRadius = radius,
            .thesisStrength = thesisStrength(view, size, radius),
            .thesisBakedKernel = baked};
}

} // namespace

std::vector<Variant> scatterVariants(const View& view, const Size& size, std::uint32_t radius) {
    return {{"thesis", thesisSettings(view, size, radius, false)},
            {"thesis-baked", thesisSettings(view, size, radius, true)},
            {"separable", {.technique = Technique::Separable}},
            {"burley", {.technique = Technique::Burley}},
            {"bank", {.technique = Technique::Bank}}};
}

std::vector<Variant> transmitVariants() {
    return {{"thesis", {.scatter = false, .thesisTransmittance = true}}, {"slab", {.scatter = false}}};
}

std::vector<Variant> qualityVariants(const View& view, const Size& size) {
    std::vector<Variant> variants;
    for (const std::uint32_t radius : thesisRadii) {
        variants.push_back({"thesis", thesisSettings(view, size, radius, false), static_cast<double>(radius)});
    }
    variants.push_back({"separable", {.technique = Technique::Separable}});
    for (const std::uint32_t budget : burleyBudgets) {
        variants.push_back(
            {"burley", {.technique = Technique::Burley, .burleySampleBudget = budget}, static_cast<double>(budget)});
    }
    variants.push_back({"bank", {.technique = Technique::Bank}});
    return variants;
}

} // namespace nacre::bench
