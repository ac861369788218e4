// Technique `bank`: one pyramid of blurs for all materials; each pixel takes its material's mixture of them
// (docs/scatter.md).
#include "pass_table.hpp"

#include "nacre/bank.hpp"

#include "bank_blur.spv.h"
#include "bank_combine_edge.spv.h"
#include "bank_combine_smooth.spv.h"
#include "bank_reduce.spv.h"

#include <algorithm>
#include <cstring>

namespace nacre::effect {
namespace {

namespace constants {
#include "shaders/bank_constants.h"
} // namespace constants

static_assert(constants::bankLevels == bankLevels && constants::bankSize == bankSize);
static_assert(constants::bankBinsPerOctave == BankTable::binsPerOctave &&
              constants::bankBinCount == BankTable::binCount);
static_assert(BankTable::halvesPerBin == 2 * bankBinWords);

constexpr std::size_t tableBytes = sizeof(std::uint32_t) * bankTableWords;
static_assert(bankTableWords == bankTableHead + bankBinWords * constants::bankBinCount && tableBytes % 16 == 0);

constexpr std::uint32_t tileSize = 32;          // px, bank.glsl
constexpr std::uint32_t blurSide = 16;          // texels, bank_blur.comp
constexpr std::uint32_t rawTexelsPerTile = 341; // levels 1 … 5

VkExtent2D tileCount(VkExtent2D area) {
    return {(area.width + tileSize - 1) / tileSize, (area.height + tileSize - 1) / tileSize};
}

VkExtent2D levelExtent(VkExtent2D area, int level) {
    const VkExtent2D tiles = tileCount(area);
    return level < bankLevels ? VkExtent2D{tiles.width * (tileSize >> level), tiles.height * (tileSize >> level)}
                              : VkExtent2D{(tiles.width + 1) / 2, (tiles.height + 1) / 2};
}

// Blocks of 16x16 texels that cover a level.
std::uint32_t blockCount(VkExtent2D level) {
    return (level.width + blurSide - 1) / blurSide * ((level.height + blurSide - 1) / blurSide);
}

// One workgroup per block of any level, in rows of at most bankDispatchWidth.
VkExtent3D blurGrid(VkExtent2D area) {
    std::uint32_t count = 0;
    for (int level = 1; level <= bankLevels; ++level) {
        count += blockCount(levelExtent(area, level));
    }
    return {std::min<std::uint32_t>(count, bankDispatchWidth), (count + bankDispatchWidth - 1) / bankDispatchWidth, 1};
}

void buildTable(const Material& material, const Profile& profile, std::span<std::byte> bytes) {
    const BankTable table(profile);
    const float head[] = {table.binOffset(), static_cast<float>(material.strength)};
    std::memcpy(bytes.data(), head, sizeof(head));
    std::memcpy(bytes.data() + sizeof(std::uint32_t) * bankTableHead, table.halves().data(),
                table.halves().size_bytes());
}

constexpr IntermediateSet blurred = bit(Intermediate::BankBlurred) | bit(Intermediate::BankSurfaces);
constexpr IntermediateSet quads = bit(Intermediate::BankQuads);
constexpr IntermediateSet areas = bit(Intermediate::BankAreas);
constexpr IntermediateSet tiles = bit(Intermediate::BankTiles);

constexpr Pass passes[] = {
    {.name = "nacre bank reduce",
     .file = "bank_reduce",
     .spirv = bank_reduce_spv,
     .writes = bit(Intermediate::BankRaw) | quads | areas | tiles,
     .grid = nacre::effect::tiles<tileSize, tileSize>,
     .asksMaterials = true},
    {.name = "nacre bank blur",
     .file = "bank_blur",
     .spirv = bank_blur_spv,
     .reads = bit(Intermediate::BankRaw),
     .writes = blurred | tiles,
     .grid = blurGrid,
     .asksMaterials = true},
    {.name = "nacre bank combine edge",
     .file = "bank_combine_edge",
     .spirv = bank_combine_edge_spv,
     .reads = blurred | quads | areas | tiles,
     .indirect = Intermediate::BankTiles,
     .indirectOffset = sizeof(BankDispatch),
     .asksMaterials = true},
    {.name = "nacre bank combine smooth",
     .file = "bank_combine_smooth",
     .spirv = bank_combine_smooth_spv,
     .reads = blurred | quads | tiles,
     .indirect = Intermediate::BankTiles,
     .indirectOffset = 0},
};

} // namespace

VkDeviceSize bankRawBytes(VkExtent2D maxExtent) {
    const VkExtent2D extent = tileCount(maxExtent);
    return VkDeviceSize{sizeof(uvec4)} * rawTexelsPerTile * extent.width * extent.height;
}

VkDeviceSize bankBlurredBytes(VkExtent2D maxExtent) {
    const VkExtent2D tiles = tileCount(maxExtent);
    const VkExtent2D coarsest = levelExtent(maxExtent, bankLevels);
    return VkDeviceSize{sizeof(uvec2)} *
           (VkDeviceSize{rawTexelsPerTile} * tiles.width * tiles.height + coarsest.width * coarsest.height);
}

// One for each texel of level 1.
VkDeviceSize bankQuadBytes(VkExtent2D maxExtent) {
    const VkExtent2D finest = levelExtent(maxExtent, 1);
    return VkDeviceSize{sizeof(uvec4)} * finest.width * finest.height;
}

VkDeviceSize bankAreaBytes(VkExtent2D maxExtent) {
    return bankQuadBytes(maxExtent) / sizeof(uvec4) * sizeof(std::uint32_t);
}

// The dispatches, then per tile its bits and, on either list, the places of its two regions.
VkDeviceSize bankTileBytes(VkExtent2D maxExtent) {
    const VkExtent2D extent = tileCount(maxExtent);
    return 2 * sizeof(BankDispatch) + VkDeviceSize{sizeof(std::uint32_t)} * 5 * extent.width * extent.height;
}

// The levels lie one after the other, finest first; their blocks are blurred coarsest first.
void setBankLevels(ScatterParameters& parameters, VkExtent2D area) {
    std::int32_t texels = 0;
    for (int level = 1; level <= bankLevels; ++level) {
        const VkExtent2D extent = levelExtent(area, level);
        const auto width = static_cast<std::int32_t>(extent.width);
        const auto height = static_cast<std::int32_t>(extent.height);
        parameters.bankLevels[level] = {texels, width, height, 0};
        texels += width * height;
    }
    std::int32_t blocks = 0;
    for (int level = bankLevels; level >= 1; --level) {
        parameters.bankLevels[level].w = blocks;
        blocks += static_cast<std::int32_t>(blockCount(levelExtent(area, level)));
    }
}

const Technique bankTechnique{"bank", passes, tableBytes, buildTable};

} // namespace nacre::effect
