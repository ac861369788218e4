#include "baselines/thesis/thesis_baking.hpp"

#include "baselines/baselines.hpp"
#include "baselines/thesis/thesis_blocks.h"
#include "contract/effect_error.hpp"
#include "vulkan/technique_choice.hpp"

#include "scatter_thesis_columns_baked.spv.h"
#include "scatter_thesis_rows_baked.spv.h"

#include <cstring>

namespace nacre::effect {
namespace {

/// The baked kernel's constants: constant_id 0 is the radius, then four floats a tap from the middle on.
struct KernelConstants {
    std::uint32_t radius;
    vec4 taps[thesisMaxRadius + 1];
};

Owned<VkPipeline> bakePass(const Context& context, const Pass& pass, const EmbeddedShader& shader,
                           const KernelConstants& constants) {
    constexpr std::uint32_t count = sizeof(KernelConstants) / sizeof(float);
    std::array<VkSpecializationMapEntry, count> entries;
    for (std::uint32_t i = 0; i < count; ++i) {
        entries[i] = {i, static_cast<std::uint32_t>(i * sizeof(float)), sizeof(float)};
    }
    const VkSpecializationInfo info{count, entries.data(), sizeof(constants), &constants};
    Pass baked = pass;
    baked.file = shader.name;
    baked.spirv = shader;
    return createPipeline(context.device, context.scatter.layout.get(), baked, VK_NULL_HANDLE, &info);
}

} // namespace

std::uint32_t thesisRadius(std::uint32_t radius, const char* field) {
    constexpr std::uint32_t defaultRadius = 5; // the thesis's experiment 1
    if (radius > thesisMaxRadius) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", radius, ", must be in [1, ", thesisMaxRadius, "]");
    }
    return radius == 0 ? defaultRadius : radius;
}

void bakeThesisKernel(Context& context, std::uint32_t materialId, std::uint32_t radius) {
    const std::size_t technique = scatterTechniqueIndex(context, NACRE_TECHNIQUE_THESIS, "technique");
    if (!context.materials->isSet(materialId)) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "materialId is ", materialId, ", which nacreSetMaterials has not set");
    }
    if (context.noMaterialIds) {
        fail(NACRE_ERROR_INVALID_ARGUMENT,
             "a kernel is baked, but NacreContextInfo::noMaterialIds is VK_TRUE: baked passes "
             "read ids");
    }
    KernelConstants constants{};
    constants.radius = thesisRadius(radius, "radius");
    const std::span<const std::byte> table = context.materials->currentTable(materialId, technique);
    std::memcpy(constants.taps, table.data() + thesisKernelStart(constants.radius) * sizeof(vec4),
                (constants.radius + 1) * sizeof(vec4));
    std::vector<Owned<VkPipeline>> pipelines;
    pipelines.push_back(bakePass(context, thesisMaterialPasses[0], scatter_thesis_rows_baked_spv, constants));
    pipelines.push_back(bakePass(context, thesisMaterialPasses[1], scatter_thesis_columns_baked_spv, constants));
    context.bakedPasses = std::move(pipelines);
    context.bakedRadius = constants.radius;
}

bool takesBakedKernel(const Context& context, const NacreScatterInfo& info) {
    if (info.technique != NACRE_TECHNIQUE_THESIS || !info.baselines || !info.baselines->thesisBakedKernel) {
        return false;
    }
    const NacreBaselineSettings& settings = *info.baselines;
    if (context.bakedPasses.empty()) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreBaselineSettings::thesisBakedKernel is ", settings.thesisBakedKernel,
             ", but nacreBakeThesisKernel was not called");
    }
    if (settings.thesisRadius != 0 && settings.thesisRadius != context.bakedRadius) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreBaselineSettings::thesisRadius is ", settings.thesisRadius,
             ", the baked kernel's is ", context.bakedRadius);
    }
    return true;
}

bool takesThesisTransmittance(const NacreTransmitInfo& info) {
    return info.baselines && info.baselines->thesisTransmittance;
}

} // namespace nacre::effect
