// Technique `bank`: one pyramid of blurs for all materials; each pixel takes its material's mixture of them
// (docs/scatter.md).
#include "bank/bank_blocks.h"
#include "technique.hpp"

#include "nacre/bank.hpp"

#include "bank_blur.spv.h"
#include "bank_combine_edge.spv.h"
#include "bank_combine_smooth.spv.h"
#include "bank_combine_smooth_half.spv.h"
#include "bank_reduce.spv.h"
#include "bank_surfaces_blur.spv.h"
#include "bank_surfaces_combine_edge.spv.h"
#include "bank_surfaces_reduce.spv.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace nacre::effect {
namespace {

namespace constants {
#include "bank/bank_constants.h"
} // namespace constants

static_assert(constants::bankLevels == bankLevels && constants::bankSize == bankSize);
static_assert(constants::bankBinsPerOctave == BankTable::binsPerOctave);
static_assert(BankTable::halvesPerBin == 3 * bankBinWords && bankBinWords == bankSize);
static_assert(constants::bankFirstOctave == BankTable::firstOctave &&
              constants::bankLastOctave == BankTable::lastOctave && bankTableBins == BankTable::binCount);

constexpr std::size_t tableBytes = sizeof(uvec4) * bankTableWords;

constexpr std::uint32_t tileSize = 16;   // px, bank.glsl
constexpr std::uint32_t cellSize = 32;   // px, 2x2 tiles, of which the pyramid is made
constexpr VkExtent2D regionSize{32, 16}; // px, bank_region.glsl
constexpr VkExtent2D blurBlock{16, 8};   // texels, bank_blur.comp
constexpr std::uint32_t blurThreads = blurBlock.width * blurBlock.height;
constexpr VkExtent2D coarsestBlurBlock{6, 2};
constexpr std::uint32_t cellTexels = 341; // levels 1 … 5

std::uint32_t ratioUp(std::uint32_t value, std::uint32_t divisor) {
    return (value + divisor - 1) / divisor;
}

VkExtent2D cellCount(VkExtent2D area) {
    return {ratioUp(area.width, cellSize), ratioUp(area.height, cellSize)};
}

VkExtent2D levelExtent(VkExtent2D area, int level) {
    const VkExtent2D cells = cellCount(area);
    return level < bankLevels ? VkExtent2D{cells.width * (cellSize >> level), cells.height * (cellSize >> level)}
                              : VkExtent2D{(cells.width + 1) / 2, (cells.height + 1) / 2};
}

// One workgroup a tile of whole cells.
VkExtent3D reduceGrid(VkExtent2D area) {
    const VkExtent2D cells = cellCount(area);
    return {cells.width * (cellSize / tileSize), cells.height * (cellSize / tileSize), 1};
}

// Workgroups that list the regions, the first of pass B.
std::uint32_t listCount(VkExtent2D area) {
    const VkExtent2D cells = cellCount(area);
    return ratioUp(cells.width * cells.height * (cellSize / regionSize.height), blurThreads);
}

// Workgroups that blur a level.
std::uint32_t blockCount(VkExtent2D area, int level) {
    const VkExtent2D extent = levelExtent(area, level);
    const VkExtent2D block = level == bankLevels ? coarsestBlurBlock : blurBlock;
    return ratioUp(extent.width, block.width) * ratioUp(extent.height, block.height);
}

// One workgroup per block of any level and for the lists, in rows of at most bankDispatchWidth.
VkExtent3D blurGrid(VkExtent2D area) {
    std::uint32_t count = listCount(area);
    for (int level = 2; level <= bankLevels; ++level) {
        count += blockCount(area, level);
    }
    return {std::min<std::uint32_t>(count, bankDispatchWidth), ratioUp(count, bankDispatchWidth), 1};
}

// Texels of the whole pyramid.
VkDeviceSize texelCount(VkExtent2D maxExtent) {
    const VkExtent2D cells = cellCount(maxExtent);
    const VkExtent2D coarsest = levelExtent(maxExtent, bankLevels);
    return VkDeviceSize{cellTexels} * cells.width * cells.height + coarsest.width * coarsest.height;
}

// Of level 1.
VkDeviceSize fineTexelCount(VkExtent2D maxExtent) {
    const VkExtent2D finest = levelExtent(maxExtent, 1);
    return VkDeviceSize{finest.width} * finest.height;
}

// A profile's weights at a bin; beyond the last, those of the last.
const std::uint16_t* weightsAt(const BankTable& table, int bin) {
    return &table.halves()[std::min(bin, BankTable::binCount - 1) * BankTable::halvesPerBin];
}

// Bits of the kernels that have a weight at a bin or the next.
std::uint32_t usedKernels(const std::uint16_t* bin, const std::uint16_t* next) {
    std::uint32_t used = 0;
    for (int i = 0; i < BankTable::halvesPerBin; ++i) {
        used |= bin[i] != 0 || next[i] != 0 ? 1u << i / 3 : 0;
    }
    return used;
}

// A kernel's weights at a bin and the next: three halves each.
uvec4 packWeights(const std::uint16_t* bin, const std::uint16_t* next) {
    const auto pack = [](std::uint16_t low, std::uint16_t high) {
        return low | static_cast<std::uint32_t>(high) << 16;
    };
    return {pack(bin[0], bin[1]), pack(next[0], next[1]), pack(bin[2], next[2]), 0};
}

void buildTable(const Material& material, const Profile& profile, std::span<std::byte> bytes) {
    const BankTable table(profile);
    const auto strength = std::bit_cast<std::uint32_t>(static_cast<float>(material.strength)) & ~0xffu;
    std::array<uvec4, bankTableWords> words{};
    for (int i = 0; i < static_cast<int>(bankTableBins); ++i) {
        const std::uint16_t* bin = weightsAt(table, i);
        const std::uint16_t* next = weightsAt(table, i + 1);
        uvec4* kernels = &words[i * bankBinWords];
        for (int kernel = 0; kernel < bankSize; ++kernel) {
            kernels[kernel] = packWeights(bin + 3 * kernel, next + 3 * kernel);
        }
        kernels[0].w = kernels[2].w = kernels[4].w = strength | usedKernels(bin, next);
    }
    std::memcpy(bytes.data(), words.data(), sizeof(words));
}

VkDeviceSize reducedBytes(VkExtent2D maxExtent) {
    return sizeof(uvec4) * texelCount(maxExtent);
}

// One for each texel but those of level 1.
VkDeviceSize blurredBytes(VkExtent2D maxExtent) {
    return sizeof(uvec2) * (texelCount(maxExtent) - fineTexelCount(maxExtent));
}

// One word for each texel of level 1.
VkDeviceSize areaBytes(VkExtent2D maxExtent) {
    return sizeof(std::uint32_t) * fineTexelCount(maxExtent);
}

// Of the levels that keep one, finest first; then again of those that are blurred.
VkDeviceSize secondBytes(VkExtent2D maxExtent) {
    VkDeviceSize texels = 0;
    for (int level = 1; level <= constants::bankSecondLevels; ++level) {
        const VkExtent2D extent = levelExtent(maxExtent, level);
        texels += VkDeviceSize{level > 1 ? 2u : 1u} * extent.width * extent.height;
    }
    return sizeof(uvec4) * texels;
}

VkDeviceSize pixelMaterialBytes(VkExtent2D maxExtent) {
    return sizeof(uvec2) * fineTexelCount(maxExtent);
}

// The dispatches, then a word for every tile, of which a cell has four, and two for every region that may be on a list:
// two smooth ones a cell, or eight edge regions.
VkDeviceSize tileBytes(VkExtent2D maxExtent) {
    const VkExtent2D cells = cellCount(maxExtent);
    return 2 * sizeof(BankDispatch) +
           VkDeviceSize{sizeof(std::uint32_t)} * (4 + 2 * (2 + 8)) * cells.width * cells.height;
}

constexpr Intermediate bankIntermediates[] = {
    {.number = intermediateBankReduced, .name = "nacre bank reduced pyramid", .bytes = reducedBytes},
    {.number = intermediateBankBlurred, .name = "nacre bank blurred pyramid", .bytes = blurredBytes},
    {.number = intermediateBankBorrowed, .name = "nacre bank borrowed surfaces", .bytes = blurredBytes},
    {.number = intermediateBankAreas, .name = "nacre bank areas", .bytes = areaBytes},
    {.number = intermediateBankTiles, .name = "nacre bank tiles", .bytes = tileBytes},
    {.number = intermediateBankMaterials, .name = "nacre bank materials", .bytes = pixelMaterialBytes},
};
constexpr Intermediate secondsIntermediate[] = {
    {.number = intermediateBankSeconds, .name = "nacre bank second surfaces", .bytes = secondBytes},
};

constexpr IntermediateSet reduced = bit(intermediateBankReduced);
constexpr IntermediateSet blurred = bit(intermediateBankBlurred) | bit(intermediateBankBorrowed);
constexpr IntermediateSet pixelMaterials = bit(intermediateBankMaterials);
constexpr IntermediateSet areas = bit(intermediateBankAreas);
constexpr IntermediateSet seconds = bit(intermediateBankSeconds);
constexpr IntermediateSet tiles = bit(intermediateBankTiles);

constexpr Pass reducePass{.name = "nacre bank reduce",
                          .file = "bank_reduce",
                          .spirv = bank_reduce_spv,
                          .writes = reduced | pixelMaterials | areas | tiles,
                          .grid = reduceGrid,
                          .constants = separateMaterials};
constexpr Pass blurPass{.name = "nacre bank blur",
                        .file = "bank_blur",
                        .spirv = bank_blur_spv,
                        .reads = reduced,
                        .writes = reduced | blurred | tiles,
                        .grid = blurGrid,
                        .constants = separateMaterials};
constexpr Pass edgePass{.name = "nacre bank combine edge",
                        .file = "bank_combine_edge",
                        .spirv = bank_combine_edge_spv,
                        .reads = reduced | blurred | pixelMaterials | areas | tiles,
                        .indirect = intermediateBankTiles,
                        .indirectOffset = sizeof(BankDispatch),
                        .constants = separateMaterials | albedoOrFactors};
constexpr Pass smoothPass{.name = "nacre bank combine smooth",
                          .file = "bank_combine_smooth",
                          .spirv = bank_combine_smooth_spv,
                          .halfFile = "bank_combine_smooth_half",
                          .halfSpirv = bank_combine_smooth_half_spv,
                          .reads = reduced | blurred | pixelMaterials | tiles,
                          .indirect = intermediateBankTiles,
                          .indirectOffset = 0,
                          .constants = albedoOrFactors};
constexpr Pass passes[] = {reducePass, blurPass, edgePass, smoothPass};

// The same pass with second surfaces.
constexpr Pass withSeconds(Pass pass, const char* file, std::span<const std::uint32_t> spirv) {
    pass.file = file;
    pass.spirv = spirv;
    pass.reads |= seconds;
    pass.writes |= pass.isIndirect() ? 0 : seconds;
    return pass;
}

constexpr Pass surfacesPasses[] = {withSeconds(reducePass, "bank_surfaces_reduce", bank_surfaces_reduce_spv),
                                   withSeconds(blurPass, "bank_surfaces_blur", bank_surfaces_blur_spv),
                                   withSeconds(edgePass, "bank_surfaces_combine_edge", bank_surfaces_combine_edge_spv),
                                   smoothPass};

// The levels lie one after the other, finest first; their blocks are blurred coarsest first.
void setParameters(const NacreScatterInfo&, VkExtent2D area, ScatterParameters& parameters) {
    std::int32_t texels = 0;
    for (int level = 1; level <= bankLevels; ++level) {
        const VkExtent2D extent = levelExtent(area, level);
        const auto width = static_cast<std::int32_t>(extent.width);
        const auto height = static_cast<std::int32_t>(extent.height);
        parameters.bankLevels[level] = {texels, width, height, 0};
        texels += width * height;
    }
    auto blocks = static_cast<std::int32_t>(listCount(area));
    for (int level = bankLevels; level >= 2; --level) {
        parameters.bankLevels[level].w = blocks;
        blocks += static_cast<std::int32_t>(blockCount(area, level));
    }
}

} // namespace

extern const Technique bankTechnique{.name = "bank",
                                     .intermediates = bankIntermediates,
                                     .passes = passes,
                                     .tableBytes = tableBytes,
                                     .buildTable = buildTable,
                                     .setParameters = setParameters};
// Its other intermediates are those of `bank`.
extern const Technique bankSurfacesTechnique{.name = "bank-surfaces",
                                             .intermediates = secondsIntermediate,
                                             .passes = surfacesPasses,
                                             .tableBytes = tableBytes,
                                             .buildTable = buildTable};

} // namespace nacre::effect
