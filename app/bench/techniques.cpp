#include "app/bench/techniques.hpp"

namespace nacre::bench {
namespace {

using renderer::Technique;

struct Row {
    const char* name;
    Technique technique;
};

constexpr Row rows[] = {{"bank", Technique::Bank}, {"separable", Technique::Separable}};

} // namespace

std::vector<Variant> scatterVariants(std::uint32_t) {
    std::vector<Variant> variants;
    for (const Row& row : rows) {
        variants.push_back({row.name, {.technique = row.technique}, 0});
    }
    return variants;
}

std::vector<Variant> transmitVariants() {
    return {{"slab", {.scatter = false}, 0}};
}

std::vector<Variant> qualityVariants() {
    return scatterVariants(0);
}

} // namespace nacre::bench
