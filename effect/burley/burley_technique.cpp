// Technique `burley`: importance samples of a disc, one pass. Closed forms for Burley's profile, tables for layers.
#include "burley/burley_blocks.h"
#include "contract/effect_error.hpp"
#include "technique.hpp"

#include "nacre/burley.hpp"

#include "scatter_burley.spv.h"

#include <algorithm>
#include <cstring>

namespace nacre::effect {
namespace {

int widestChannel(const Profile& profile) {
    int widest = 0;
    for (int channel = 1; channel < 3; ++channel) {
        if (profile.inverseCdf(channel, radiusShare) > profile.inverseCdf(widest, radiusShare)) {
            widest = channel;
        }
    }
    return widest;
}

void buildTable(const Material&, const Profile& profile, std::span<std::byte> bytes) {
    BurleyTable table{};
    const int widest = widestChannel(profile);
    table.widest = static_cast<std::uint32_t>(widest);
    table.share = static_cast<float>(radiusShare);
    const double radius = profile.quantileRadius(radiusShare);
    if (const auto* burley = dynamic_cast<const BurleyProfile*>(&profile)) {
        table.meanFreePath = toVec4(burley->meanFreePath(), 0);
    }
    for (std::size_t i = 0; i < burleyEntries; ++i) {
        const double share = static_cast<double>(i) / (burleyEntries - 1);
        const double r = radius * std::max(share * share, 1e-12); // Burley's R is infinite at 0
        const double quantile = profile.inverseCdf(widest, radiusShare * (1 - (1 - share) * (1 - share)));
        table.radial[i] =
            toVec4({profile.radial(0, r), profile.radial(1, r), profile.radial(2, r)}, quantile * quantile);
        table.cumulative[i] = toVec4({profile.cdf(0, r), profile.cdf(1, r), profile.cdf(2, r)}, 0);
    }
    std::memcpy(bytes.data(), &table, sizeof(table));
}

void setParameters(const NacreScatterInfo& info, VkExtent2D, ScatterParameters& parameters) {
    constexpr std::uint32_t defaultBudget = 64;
    constexpr std::uint32_t largestBudget = 256;
    if (info.burleySampleBudget > largestBudget) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::burleySampleBudget is ", info.burleySampleBudget,
             ", must be in [1, ", largestBudget, "]");
    }
    parameters.burleySampleBudget = info.burleySampleBudget == 0 ? defaultBudget : info.burleySampleBudget;
    parameters.burleyRotation = info.burleyRotation;
}

constexpr Pass passes[] = {
    {.name = "nacre burley", .file = "scatter_burley", .spirv = scatter_burley_spv, .grid = tiles<8, 8>}};

} // namespace

extern const Technique burleyTechnique{.name = "burley",
                                       .passes = passes,
                                       .tableBytes = sizeof(BurleyTable),
                                       .buildTable = buildTable,
                                       .setParameters = setParameters};

} // namespace nacre::effect
