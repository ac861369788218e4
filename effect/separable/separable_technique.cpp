// Technique `separable`: two passes for all materials with pre-integrated line-spread kernels (Jimenez et al. 2015).
#include "separable/separable_blocks.h"
#include "technique.hpp"

#include "scatter_separable_columns.spv.h"
#include "scatter_separable_rows.spv.h"

#include <cstring>

namespace nacre::effect {
namespace {

void buildTable(const Material&, const Profile& profile, std::span<std::byte> table) {
    const double radius = profile.quantileRadius(radiusShare);
    for (std::size_t i = 0; i < lineSpreadEntries; ++i) {
        const double share = static_cast<double>(i) / (lineSpreadEntries - 1);
        const double x = radius * share * share;
        const auto mass = [&](int channel) {
            return static_cast<float>(profile.lineSpreadCumulative(channel, x) - 0.5);
        };
        const vec4 entry{mass(0), mass(1), mass(2), 0};
        std::memcpy(table.data() + i * sizeof(entry), &entry, sizeof(entry));
    }
}

constexpr Intermediate separableIntermediates[] = {rowsIntermediate};

constexpr Pass passes[] = {
    {.name = "nacre separable rows",
     .file = "scatter_separable_rows",
     .spirv = scatter_separable_rows_spv,
     .writes = bit(intermediateRows),
     .grid = tiles<8, 8>},
    {.name = "nacre separable columns",
     .file = "scatter_separable_columns",
     .spirv = scatter_separable_columns_spv,
     .reads = bit(intermediateRows),
     .grid = tiles<8, 8>},
};

} // namespace

extern const Technique separableTechnique{.name = "separable",
                                          .intermediates = separableIntermediates,
                                          .passes = passes,
                                          .tableBytes = lineSpreadEntries * sizeof(vec4),
                                          .buildTable = buildTable};

} // namespace nacre::effect
