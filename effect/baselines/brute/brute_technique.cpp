// Technique `brute`: every pixel within the 99.9 % radius, true distance and area. The reference of the others.
#include "baselines/brute/brute_blocks.h"
#include "technique.hpp"

#include "nacre/burley.hpp"
#include "nacre/gaussian.hpp"

#include "scatter_brute_gather.spv.h"
#include "scatter_brute_pixels.spv.h"

#include <cstring>

namespace nacre::effect {
namespace {

void buildTable(const Material&, const Profile& profile, std::span<std::byte> bytes) {
    BruteTable table{};
    if (const auto* gaussians = dynamic_cast<const SumOfGaussiansProfile*>(&profile)) {
        const std::span<const Layer> layers = gaussians->layers();
        table.meanFreePath.w = static_cast<float>(layers.size());
        for (std::size_t i = 0; i < layers.size(); ++i) {
            table.layers[i] = toVec4(layers[i].weight, layers[i].variance);
        }
    } else if (const auto* burley = dynamic_cast<const BurleyProfile*>(&profile)) {
        table.meanFreePath = toVec4(burley->meanFreePath(), 0);
    }
    const double radius = profile.quantileRadius(radiusShare);
    for (std::size_t i = 1; i < radialEntries; ++i) {
        const double share = static_cast<double>(i) / (radialEntries - 1);
        const double r = radius * share * share;
        table.radial[i] = toVec4({profile.radial(0, r), profile.radial(1, r), profile.radial(2, r)}, 0);
    }
    table.radial[0] = table.radial[1]; // R may be infinite at 0
    std::memcpy(bytes.data(), &table, sizeof(table));
}

constexpr Intermediate bruteIntermediates[] = {
    {.number = intermediatePixels,
     .name = "nacre brute pixels",
     .bytes = [](VkExtent2D extent) { return VkDeviceSize{sizeof(BrutePixel)} * extent.width * extent.height; }},
    {.number = intermediateSums,
     .name = "nacre brute sums",
     .bytes = [](VkExtent2D extent) { return VkDeviceSize{sizeof(BruteSum)} * extent.width * extent.height; }},
};

std::uint32_t bands(VkExtent2D area) {
    const std::uint32_t rows = bruteBandRows(area.width);
    return (area.height + rows - 1) / rows;
}

constexpr Pass passes[] = {
    {.name = "nacre brute pixels",
     .file = "scatter_brute_pixels",
     .spirv = scatter_brute_pixels_spv,
     .writes = bit(intermediatePixels),
     .grid = tiles<8, 8>},
    {.name = "nacre brute gather",
     .file = "scatter_brute_gather",
     .spirv = scatter_brute_gather_spv,
     .reads = bit(intermediatePixels) | bit(intermediateSums),
     .writes = bit(intermediateSums),
     .grid = tiles<8, 8>,
     .repeats = bands},
};

} // namespace

extern const Technique bruteTechnique{.name = "brute",
                                      .intermediates = bruteIntermediates,
                                      .passes = passes,
                                      .tableBytes = sizeof(BruteTable),
                                      .buildTable = buildTable,
                                      .isBaseline = true};

} // namespace nacre::effect
