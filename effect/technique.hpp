// What the effect is made of, as data: intermediates, passes and techniques. Set layouts, allocations, barriers,
// labels, timestamps and costs follow from these tables. A new technique is its shaders, one .cpp that defines a
// Technique, its rows in `intermediates` and its name in `scatterTechniques`.
#pragma once

#include "interface/blocks.h"
#include "nacre/material.hpp"
#include "nacre/nacre.h"

#include <array>
#include <cstddef>
#include <span>

namespace nacre::effect {

/// Images and buffers between passes, in the order of the intermediate… constants of blocks.h.
enum class Intermediate : std::uint32_t {
    Rows = intermediateRows,
    Pixels = intermediatePixels,
    NoShadowMap = intermediateNoShadowMap,
    BankRaw = intermediateBankRaw,
    BankBlurred = intermediateBankBlurred,
    BankSurfaces = intermediateBankSurfaces,
    BankAreas = intermediateBankAreas,
    BankTiles = intermediateBankTiles,
    BankMaterials = intermediateBankMaterials,
    BankSeconds = intermediateBankSeconds,
    Count
};
inline constexpr std::size_t intermediateCount = static_cast<std::size_t>(Intermediate::Count);

/// A set of intermediates, one bit each.
using IntermediateSet = std::uint32_t;
constexpr IntermediateSet bit(Intermediate intermediate) {
    return 1u << static_cast<std::uint32_t>(intermediate);
}

/// An intermediate: a storage image of `format` and `extent`, or, with VK_FORMAT_UNDEFINED, a storage buffer of
/// `bytes`.
struct IntermediateInfo {
    const char* name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D (*extent)(VkExtent2D maxExtent) = nullptr;
    VkDeviceSize (*bytes)(VkExtent2D maxExtent) = nullptr;
    bool array = false; ///< the view is a 2D array view
};
extern const std::array<IntermediateInfo, intermediateCount> intermediates;

/// One compute dispatch.
struct Pass {
    const char* name; ///< debug label and timestamp name
    const char* file; ///< what nacre_shader calls it
    std::span<const std::uint32_t> spirv;
    /// In its place with NacreContextInfo::shaderFloat16; null, empty = none.
    const char* halfFile = nullptr;
    std::span<const std::uint32_t> halfSpirv = {};
    IntermediateSet reads = 0;
    IntermediateSet writes = 0;
    /// Workgroups for a render area, in px.
    VkExtent3D (*grid)(VkExtent2D area) = nullptr;
    /// Instead of `grid`: the VkDispatchIndirectCommand is at indirectOffset of this buffer; Count = not indirect.
    Intermediate indirect = Intermediate::Count;
    VkDeviceSize indirectOffset = 0;
    /// Whether it has the constant separateMaterials, true for frames where some materials do not exchange light with
    /// some others: asking costs nothing where no one does.
    bool asksMaterials = false;
    /// The same with the constant severalShadowMaps, for calls with more than one.
    bool asksShadowMaps = false;
    /// The same with the constant albedoOrStrength, for calls with such an image or a material of strength below 1.
    bool asksAlbedoOrStrength = false;
};

/// Which of a pass's pipelines: a bit for every specialization constant that is true, by its constant_id.
using Variant = std::uint32_t;
inline constexpr Variant separateMaterials = 1u << 0;
inline constexpr Variant severalShadowMaps = 1u << 0; // transmit's, where the former is scatter's
inline constexpr Variant albedoOrStrength = 1u << 1;
inline constexpr std::size_t variantCount = 4;

/// The constants that a pass has.
constexpr Variant variantsOf(const Pass& pass) {
    return (pass.asksMaterials ? separateMaterials : 0) | (pass.asksShadowMaps ? severalShadowMaps : 0) |
           (pass.asksAlbedoOrStrength ? albedoOrStrength : 0);
}

/// Sizes of the bank's buffers (bank/bank_technique.cpp).
VkDeviceSize bankRawBytes(VkExtent2D maxExtent);
VkDeviceSize bankBlurredBytes(VkExtent2D maxExtent);
VkDeviceSize bankAreaBytes(VkExtent2D maxExtent);
VkDeviceSize bankMaterialBytes(VkExtent2D maxExtent);
VkDeviceSize bankSecondBytes(VkExtent2D maxExtent);
VkDeviceSize bankTileBytes(VkExtent2D maxExtent);
/// Fills ScatterParameters::bankLevels for a render area (bank/bank_technique.cpp).
void setBankLevels(ScatterParameters& parameters, VkExtent2D area);

/// A grid of one workgroup per width × height px.
template <std::uint32_t width, std::uint32_t height> VkExtent3D tiles(VkExtent2D area) {
    return {(area.width + width - 1) / width, (area.height + height - 1) / height, 1};
}

/// The share of the light within MaterialParameters::radius, at which the tables of the techniques end.
inline constexpr double radiusShare = 0.999;

/// A table entry of the shaders.
inline vec4 toVec4(const Rgb& rgb, double w) {
    return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2]), static_cast<float>(w)};
}

/// A way to scatter, or transmit: its passes in order, and the table it needs of every material.
struct Technique {
    const char* name;
    std::span<const Pass> passes;
    std::size_t tableBytes; ///< per material, a multiple of 16
    /// Fills one material's table (tableBytes, zeroed).
    void (*buildTable)(const Material& material, const Profile& profile, std::span<std::byte> table);
    /// After `passes`, for one material after another; its slot is pushed. Timed
    /// as one, under materialPassesName.
    std::span<const Pass> materialPasses = {};
    const char* materialPassesName = nullptr;

    IntermediateSet uses() const;
};

extern const Technique separableTechnique;
extern const Technique bruteTechnique;
extern const Technique bankTechnique;
extern const Technique burleyTechnique;
extern const Technique thesisTechnique;
extern const Technique bankSurfacesTechnique;
extern const Technique transmitTechnique;

/// Every technique the tables know: scatterTechniques[NacreTechnique - 1], then transmit.
inline constexpr std::size_t scatterTechniqueCount = 6;
inline constexpr std::size_t transmitIndex = scatterTechniqueCount;
inline constexpr std::size_t techniqueCount = scatterTechniqueCount + 1;
extern const std::array<const Technique*, techniqueCount> techniques;
inline constexpr NacreTechnique defaultTechnique = NACRE_TECHNIQUE_BANK;

} // namespace nacre::effect
