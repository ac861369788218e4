// What the effect is made of, as data: techniques, their passes and what lies between these. Set layouts, allocations,
// barriers, labels, timestamps and costs follow from this. A new technique is a folder: its shaders, and one .cpp that
// defines a Technique, which stands in the table of technique_table.cpp.
#pragma once

#include "interface/blocks.h"
#include "nacre/material.hpp"
#include "nacre/nacre.h"

#include <array>
#include <cstddef>
#include <span>

namespace nacre::effect {

/// Images and buffers between passes have numbers, the intermediate… constants of the headers of blocks; they are bound
/// from bindingIntermediates to 31.
inline constexpr std::uint32_t maxIntermediates = 32 - bindingIntermediates;

/// A set of intermediates, one bit each.
using IntermediateSet = std::uint32_t;
constexpr IntermediateSet bit(std::uint32_t intermediate) {
    return 1u << intermediate;
}

/// An intermediate: a storage image of `format` and `extent`, or, with VK_FORMAT_UNDEFINED, a storage buffer of
/// `bytes`.
struct Intermediate {
    std::uint32_t number;
    const char* name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D (*extent)(VkExtent2D maxExtent) = nullptr;
    VkDeviceSize (*bytes)(VkExtent2D maxExtent) = nullptr;
    bool array = false; ///< the view is a 2D array view
};

/// Light after a pass over rows, of every technique with such a pass.
inline constexpr Intermediate rowsIntermediate{.number = intermediateRows,
                                               .name = "nacre rows",
                                               .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                               .extent = [](VkExtent2D extent) { return extent; }};

/// Optional images that are given, bits 1u << NacreImageSlot.
using ImageSet = std::uint32_t;

/// Which of a pass's pipelines: a bit for every specialization constant that is true, by its constant_id. Asking costs
/// nothing in the pipelines where it is false.
using Variant = std::uint32_t;
inline constexpr Variant separateMaterials = 1u << 0; ///< scatter's: some do not exchange light with some others
inline constexpr Variant albedoOrFactors =
    1u << 1; ///< scatter's: an image of albedo, strength or scale, or a material of strength below 1
inline constexpr Variant severalShadowMaps = 1u << 0; ///< transmit's: more than one
inline constexpr Variant generalCall =
    1u << 1; ///< transmit's: a light with more than a linear map of its own, or an image of scales
inline constexpr std::size_t variantCount = 4;

/// One compute dispatch, or several of one pipeline.
struct Pass {
    static constexpr std::uint32_t notIndirect = ~0u;
    constexpr bool isIndirect() const { return indirect != notIndirect; }

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
    /// How often it is dispatched, one after the other; the dispatch's number, from 0, is pushed. Null = once, without.
    std::uint32_t (*repeats)(VkExtent2D area) = nullptr;
    /// Instead of `grid`: the VkDispatchIndirectCommand is at indirectOffset of this intermediate.
    std::uint32_t indirect = notIndirect;
    VkDeviceSize indirectOffset = 0;
    /// The constants that it has.
    Variant constants = 0;
};

/// Dispatches of a pass for a render area.
inline std::uint32_t repeatsOf(const Pass& pass, VkExtent2D area) {
    return pass.repeats ? pass.repeats(area) : 1;
}

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

/// A way to scatter, or transmit: its passes in order, what lies between them, and the table it needs of every
/// material.
struct Technique {
    const char* name = nullptr;
    std::span<const Intermediate> intermediates = {};
    std::span<const Pass> passes = {};
    std::size_t tableBytes = 0; ///< per material, a multiple of 16
    /// Fills one material's table (tableBytes, zeroed).
    void (*buildTable)(const Material& material, const Profile& profile, std::span<std::byte> table) = nullptr;
    /// After `passes`, for one material after another; its slot is pushed. Timed
    /// as one, under materialPassesName.
    std::span<const Pass> materialPasses = {};
    const char* materialPassesName = nullptr;
    /// Fills its part of a call's parameters; throws an EffectError that names the field. Null: it has none.
    void (*setParameters)(const NacreScatterInfo& info, VkExtent2D area, ScatterParameters& parameters) = nullptr;

    bool isBaseline = false;

    /// Not where a baseline was left out of the build.
    bool isBuilt() const { return name != nullptr; }
    IntermediateSet uses() const;
};

extern const Technique transmitTechnique;
extern const Technique composeTechnique;

/// The index of a technique of scatter is NacreTechnique - 1; transmission and composing come last.
inline constexpr std::size_t scatterTechniqueCount = NACRE_TECHNIQUE_COUNT - 1;
inline constexpr std::size_t transmitIndex = scatterTechniqueCount;
inline constexpr std::size_t composeIndex = transmitIndex + 1;
inline constexpr std::size_t techniqueCount = composeIndex + 1;
extern const std::array<const Technique*, techniqueCount> techniques;

/// Of all techniques, by number; a number that no technique has lacks a name.
const std::array<Intermediate, maxIntermediates>& intermediates();

inline constexpr NacreTechnique defaultTechnique = NACRE_TECHNIQUE_BANK;

} // namespace nacre::effect
