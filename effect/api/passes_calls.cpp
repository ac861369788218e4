// nacre_passes.h: what a context is made of, for those who do without one.
#include "api/guard.hpp"
#include "contract/list.hpp"
#include "contract/material_check.hpp"
#include "contract/parameters.hpp"
#include "contract/validation.hpp"
#include "transmit/light_parameters.hpp"
#include "transmit/transmit_blocks.h"
#include "vulkan/bindings.hpp"

#include "nacre/nacre_baselines.h"
#include "nacre/nacre_passes.h"

#include <algorithm>
#include <cstring>

namespace nacre::effect {
namespace {

constexpr VkExtent2D largestExtent{16384, 16384};

template <typename Body> NacreResult guarded(const NacreMessages* messages, Body&& body) {
    return guard(messages ? messages->callback : nullptr, messages ? messages->userData : nullptr, body);
}

const Technique& techniqueOf(NacreTechnique technique) {
    if (technique == NACRE_TECHNIQUE_TRANSMIT) {
        return transmitTechnique;
    }
    const NacreTechnique chosen = technique == NACRE_TECHNIQUE_DEFAULT ? defaultTechnique : technique;
    if (chosen < 1 || static_cast<std::size_t>(chosen) > scatterTechniqueCount) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "technique is ", static_cast<int>(technique),
             ", must be a NacreTechnique or NACRE_TECHNIQUE_TRANSMIT");
    }
    const auto index = static_cast<std::size_t>(chosen) - 1;
    checkBuilt(index, "technique");
    return *techniques[index];
}
static_assert(NACRE_TECHNIQUE_TRANSMIT >= NACRE_TECHNIQUE_COUNT);

void checkExtent(VkExtent2D extent, const char* field) {
    if (extent.width == 0 || extent.height == 0 || extent.width > largestExtent.width ||
        extent.height > largestExtent.height) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", extent.width, "x", extent.height,
             ", each side must be in [1, ", largestExtent.width, "] px");
    }
}

/// Checks a block that is to take `needed` bytes.
void checkBlock(const void* data, std::size_t size, std::size_t needed) {
    checkGiven(data, "data");
    if (size < needed) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "size is ", size, ", the block takes ", needed, " bytes");
    }
}

template <typename Block> void fillBlock(const Block& block, std::size_t size, void* data) {
    checkBlock(data, size, sizeof(block));
    std::memcpy(data, &block, sizeof(block));
}

constexpr std::uint32_t bitOf(NacreImageSlot slot) {
    return 1u << slot;
}

void checkOptional(std::uint32_t images, std::uint32_t known) {
    if ((images & ~known) != 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "images is 0x", std::hex, images, ", knows only the bits 0x", known);
    }
}

/// Intermediates are bound from bindingIntermediates on.
std::uint32_t bindingBits(IntermediateSet set) {
    return set << bindingIntermediates;
}

NacrePass passOf(const Pass& pass, VkExtent2D area, bool perMaterial) {
    NacrePass result{};
    result.name = pass.name;
    result.file = pass.file;
    result.spirv = pass.spirv.data();
    result.spirvSize = pass.spirv.size_bytes();
    result.halfFile = pass.halfFile;
    result.halfSpirv = pass.halfSpirv.data();
    result.halfSpirvSize = pass.halfSpirv.size_bytes();
    result.reads = bindingBits(pass.reads);
    result.writes = bindingBits(pass.writes);
    result.perMaterial = perMaterial;
    result.repeats = repeatsOf(pass, area);
    result.constants = pass.constants;
    if (pass.isIndirect()) {
        result.indirectBinding = bindingIntermediates + pass.indirect;
        result.indirectOffset = pass.indirectOffset;
    } else {
        result.groups = pass.grid(area);
    }
    return result;
}

} // namespace
} // namespace nacre::effect

using namespace nacre::effect;

NacreResult nacreGetBindings(NacreTechnique technique, VkExtent2D maxExtent, uint32_t* bindingCount,
                             NacreBinding* bindings) {
    return guarded(nullptr, [&] {
        const Technique& chosen = techniqueOf(technique);
        checkExtent(maxExtent, "maxExtent");
        const CallKind kind = &chosen == &transmitTechnique ? CallKind::Transmit : CallKind::Scatter;
        std::vector<NacreBinding> all = bindingsOf(kind, chosen.uses(), maxExtent);
        const auto isTables = [](const NacreBinding& one) { return one.binding == bindingTables; };
        std::find_if(all.begin(), all.end(), isTables)->stride = chosen.tableBytes;
        handOver(std::span<const NacreBinding>(all), bindingCount, bindings, "bindingCount");
    });
}

NacreResult nacreGetPasses(NacreTechnique technique, VkExtent2D area, uint32_t* passCount, NacrePass* passes) {
    return guarded(nullptr, [&] {
        const Technique& chosen = techniqueOf(technique);
        checkExtent(area, "area");
        std::vector<NacrePass> all;
        for (const Pass& pass : chosen.passes) {
            all.push_back(passOf(pass, area, false));
        }
        for (const Pass& pass : chosen.materialPasses) {
            all.push_back(passOf(pass, area, true));
        }
        handOver(std::span<const NacrePass>(all), passCount, passes, "passCount");
    });
}

NacreResult nacreFillMaterial(const NacreMaterial* material, const NacreMessages* messages, size_t size, void* data) {
    return guarded(messages, [&] {
        checkGiven(material, "material");
        fillBlock(checkMaterial(*material, 0).parameters, size, data);
    });
}

NacreResult nacreFillTable(NacreTechnique technique, const NacreMaterial* material, const NacreMessages* messages,
                           size_t size, void* data) {
    return guarded(messages, [&] {
        const Technique& chosen = techniqueOf(technique);
        checkGiven(material, "material");
        checkBlock(data, size, chosen.tableBytes);
        const CheckedMaterial checked = checkMaterial(*material, 0);
        std::vector<std::byte> table(chosen.tableBytes);
        chosen.buildTable(checked.material, *checked.profile, table);
        std::memcpy(data, table.data(), table.size());
    });
}

NacreResult nacreFillScatterParameters(const NacreScatterInfo* info, uint32_t images, const NacreMessages* messages,
                                       size_t size, void* data) {
    return guarded(messages, [&] {
        checkGiven(info, "NacreScatterInfo");
        checkOptional(images, bitOf(NACRE_IMAGE_NORMAL) | bitOf(NACRE_IMAGE_STRENGTH) | bitOf(NACRE_IMAGE_SCALE) |
                                  bitOf(NACRE_IMAGE_ALBEDO));
        if (info->baselines && info->baselines->thesisBakedKernel) {
            fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreBaselineSettings::thesisBakedKernel is ",
                 info->baselines->thesisBakedKernel,
                 ", must be VK_FALSE: the passes of nacreGetPasses read their kernels from the tables");
        }
        const VkRect2D area = renderArea(info->view, info->irradiance.extent, largestExtent, "NacreScatterInfo");
        checkCovers(info->depth.extent, area, "NacreScatterInfo::depth");
        checkCovers(info->materialId.extent, area, "NacreScatterInfo::materialId");
        fillBlock(scatterParameters(*info, images, area, true), size, data);
    });
}

NacreResult nacreFillTransmitParameters(const NacreTransmitInfo* info, uint32_t images, const NacreMessages* messages,
                                        size_t size, void* data) {
    return guarded(messages, [&] {
        checkGiven(info, "NacreTransmitInfo");
        checkOptional(images, bitOf(NACRE_IMAGE_NORMAL) | bitOf(NACRE_IMAGE_STRENGTH) | bitOf(NACRE_IMAGE_SCALE) |
                                  bitOf(NACRE_IMAGE_THICKNESS) | bitOf(NACRE_IMAGE_THICKNESS_OUT));
        const VkRect2D area = renderArea(info->view, info->depth.extent, largestExtent, "NacreTransmitInfo");
        fillBlock(transmitParameters(*info, images, area), size, data);
    });
}

uint32_t nacreGetLightElementCount(const NacreTransmitInfo* info) {
    return info && (info->lights || info->lightCount == 0) ? lightElementCount(*info) : 0;
}

NacreResult nacreFillLights(const NacreTransmitInfo* info, const NacreMessages* messages, size_t size, void* data) {
    return guarded(messages, [&] {
        checkGiven(info, "NacreTransmitInfo");
        checkLights(*info);
        if (info->lightCount > 0) {
            checkBlock(data, size, lightElementCount(*info) * sizeof(LightParameters));
            fillLights(*info, static_cast<std::byte*>(data));
        }
    });
}

uint32_t nacreGetScatterConstants(uint32_t images, uint32_t materialCount, const NacreMaterial* materials) {
    std::uint32_t common = ~0u;
    bool havePartialStrength = false;
    for (const NacreMaterial& material : std::span(materials, materials ? materialCount : 0)) {
        common &= material.exchangeGroups;
        havePartialStrength = havePartialStrength || material.strength < 1;
    }
    return scatterVariant(images, common == 0, havePartialStrength);
}

uint32_t nacreGetTransmitConstants(uint32_t images, const NacreTransmitInfo* info) {
    return info && (info->lights || info->lightCount == 0) ? variantOf(*info, images) : 0;
}
