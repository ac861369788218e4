// Technique `thesis`: a pass pair per material with a slice kernel, as in Andersen's appendix B. The kernel comes from
// the material's table, or is compiled into the pair (nacreBakeThesisKernel).
#include "baselines/thesis/thesis_blocks.h"
#include "contract/validation.hpp"
#include "vulkan/context.hpp"

#include "nacre/kernel.hpp"

#include "scatter_thesis_columns.spv.h"
#include "scatter_thesis_columns_baked.spv.h"
#include "scatter_thesis_copy.spv.h"
#include "scatter_thesis_rows.spv.h"
#include "scatter_thesis_rows_baked.spv.h"

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

std::uint32_t radiusOrDefault(std::uint32_t radius, const char* field) {
    constexpr std::uint32_t defaultRadius = 5; // the thesis's experiment 1
    if (radius > thesisMaxRadius) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", radius, ", must be in [1, ", thesisMaxRadius, "]");
    }
    return radius == 0 ? defaultRadius : radius;
}

void setParameters(const NacreScatterInfo& info, VkExtent2D, ScatterParameters& parameters) {
    constexpr float defaultStrength = 0.1f;
    checkRange(info.thesisStrength, 0, 1e6f, "NacreScatterInfo::thesisStrength");
    parameters.thesisStrength = info.thesisStrength == 0 ? defaultStrength : info.thesisStrength;
    parameters.thesisRadius = radiusOrDefault(info.thesisRadius, "NacreScatterInfo::thesisRadius");
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

constexpr Pass materialPasses[] = {
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

/// The baked kernel's constants: constant_id 0 is the radius, then four floats a tap from the middle on.
struct KernelConstants {
    std::uint32_t radius;
    vec4 taps[thesisMaxRadius + 1];
};

Owned<VkPipeline> bakePass(const Context& context, const Pass& pass, std::span<const std::uint32_t> spirv,
                           const KernelConstants& constants) {
    constexpr std::uint32_t count = sizeof(KernelConstants) / sizeof(float);
    std::array<VkSpecializationMapEntry, count> entries;
    for (std::uint32_t i = 0; i < count; ++i) {
        entries[i] = {i, static_cast<std::uint32_t>(i * sizeof(float)), sizeof(float)};
    }
    const VkSpecializationInfo info{count, entries.data(), sizeof(constants), &constants};
    Pass baked = pass;
    baked.spirv = spirv;
    return createPipeline(context.device, context.scatter.layout.get(), baked, VK_NULL_HANDLE, &info);
}

void bake(Context& context, std::uint32_t materialId, std::uint32_t radius) {
    const std::size_t technique = scatterTechniqueIndex(context, NACRE_TECHNIQUE_THESIS, "technique");
    if (!context.materials->isSet(materialId)) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "materialId is ", materialId, ", which nacreSetMaterials has not set");
    }
    KernelConstants constants{};
    constants.radius = radiusOrDefault(radius, "radius");
    const std::span<const std::byte> table = context.materials->currentTable(materialId, technique);
    std::memcpy(constants.taps, table.data() + thesisKernelStart(constants.radius) * sizeof(vec4),
                (constants.radius + 1) * sizeof(vec4));
    std::vector<Owned<VkPipeline>> pipelines;
    pipelines.push_back(bakePass(context, materialPasses[0], scatter_thesis_rows_baked_spv, constants));
    pipelines.push_back(bakePass(context, materialPasses[1], scatter_thesis_columns_baked_spv, constants));
    context.bakedThesis = std::move(pipelines);
    context.bakedThesisRadius = constants.radius;
}

} // namespace

extern const Technique thesisTechnique{.name = "thesis",
                                       .intermediates = thesisIntermediates,
                                       .passes = copyPass,
                                       .tableBytes = thesisTaps * sizeof(vec4),
                                       .buildTable = buildTable,
                                       .materialPasses = materialPasses,
                                       .materialPassesName = "nacre thesis materials",
                                       .setParameters = setParameters};

} // namespace nacre::effect

NacreResult nacreBakeThesisKernel(NacreContext context, uint32_t materialId, uint32_t radius) {
    using namespace nacre::effect;
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] { bake(*context, materialId, radius); });
}
