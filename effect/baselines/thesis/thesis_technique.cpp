// Technique `thesis`: a pass pair per material with a slice kernel, as in Andersen's appendix B. The kernel comes from
// the material's table, or is compiled into the pair (thesis_baking.cpp).
#include "baselines/baselines.hpp"
#include "baselines/thesis/thesis_baking.hpp"
#include "baselines/thesis/thesis_blocks.h"
#include "contract/validation.hpp"

#include "nacre/kernel.hpp"

#include "scatter_thesis_columns.spv.h"
#include "scatter_thesis_copy.spv.h"
#include "scatter_thesis_rows.spv.h"

#include <cstring>

namespace nacre::effect {
namespace {

/// Where the taps end, mm: the separable demo's range, which the thesis builds on (Jimenez et al. 2012).
double kernelExtent(std::uint32_t radius) {
    return 2 * radius + 1 > 20 ? 3 : 2;
}

void buildTable(const Material& material, const Profile&, std::span<std::byte> table) {
    const std::vector<Layer> layers = makeLayers(material);
    for (std::uint32_t radius = 1; radius <= thesisMaxRadius; ++radius) {
        const Kernel kernel = sliceKernel(layers, static_cast<int>(radius), kernelExtent(radius));
        for (std::uint32_t i = 0; i <= radius; ++i) {
            const KernelTap& tap = kernel[radius + i];
            const vec4 entry = toVec4(tap.weight, tap.offset);
            std::memcpy(table.data() + (thesisKernelStart(radius) + i) * sizeof(entry), &entry, sizeof(entry));
        }
    }
}

void setParameters(const NacreScatterInfo& info, VkExtent2D, ScatterParameters& parameters) {
    constexpr float defaultStrength = 0.1f;
    const NacreBaselineSettings settings = info.baselines ? *info.baselines : NacreBaselineSettings{};
    checkRange(settings.thesisStrength, 0, 1e6f, "NacreBaselineSettings::thesisStrength");
    parameters.thesisStrength = settings.thesisStrength == 0 ? defaultStrength : settings.thesisStrength;
    parameters.thesisRadius = thesisRadius(settings.thesisRadius, "NacreBaselineSettings::thesisRadius");
}

VkExtent3D rowGroups(VkExtent2D area) {
    return tiles<thesisGroupSize, 1>(area);
}

VkExtent3D columnGroups(VkExtent2D area) {
    return tiles<1, thesisGroupSize>(area);
}

constexpr Pass copyPass[] = {{.name = "nacre thesis copy",
                              .file = "scatter_thesis_copy",
                              .spirv = scatter_thesis_copy_spv,
                              .grid = tiles<8, 8>}};

constexpr Intermediate thesisIntermediates[] = {rowsIntermediate};

} // namespace

extern const Pass thesisMaterialPasses[2] = {
    {.name = "nacre thesis rows",
     .file = "scatter_thesis_rows",
     .spirv = scatter_thesis_rows_spv,
     .writes = bit(intermediateRows),
     .grid = rowGroups},
    {.name = "nacre thesis columns",
     .file = "scatter_thesis_columns",
     .spirv = scatter_thesis_columns_spv,
     .reads = bit(intermediateRows),
     .grid = columnGroups},
};

extern const Technique thesisTechnique{.name = "thesis",
                                       .intermediates = thesisIntermediates,
                                       .passes = copyPass,
                                       .tableBytes = thesisTaps * sizeof(vec4),
                                       .buildTable = buildTable,
                                       .materialPasses = thesisMaterialPasses,
                                       .materialPassesName = "nacre thesis materials",
                                       .setParameters = setParameters,
                                       .isBaseline = true};

} // namespace nacre::effect
