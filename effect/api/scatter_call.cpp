// nacreCmdScatter: checks the arguments, fills descriptors and parameters, records the technique's passes.
#include "contract/parameters.hpp"
#include "contract/validation.hpp"
#include "vulkan/recording.hpp"

#include <cstring>

namespace nacre::effect {

std::size_t scatterTechniqueIndex(const Context& context, NacreTechnique technique, const char* field) {
    const NacreTechnique chosen = technique == NACRE_TECHNIQUE_DEFAULT ? defaultTechnique : technique;
    if (chosen < 1 || static_cast<std::size_t>(chosen) > scatterTechniqueCount) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", static_cast<int>(technique), ", must be a NacreTechnique");
    }
    const auto index = static_cast<std::size_t>(chosen) - 1;
    if (!context.enabled[index]) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", nacreTechniqueString(chosen),
             ", which is not among NacreContextInfo::techniques");
    }
    return index;
}

std::size_t chosenTechniqueIndex(const Context& context, std::size_t asked, const MaterialTable::Summary& materials) {
    constexpr std::size_t bank = NACRE_TECHNIQUE_BANK - 1;
    constexpr std::size_t bankSurfaces = NACRE_TECHNIQUE_BANK_SURFACES - 1;
    return asked == bank && materials.haveSecondSurfaces && context.enabled[bankSurfaces] ? bankSurfaces : asked;
}

namespace {

constexpr struct {
    NacreImageSlot slot;
    NacreImage NacreScatterInfo::*image;
    const char* field;
} images[] = {
    {NACRE_IMAGE_IRRADIANCE, &NacreScatterInfo::irradiance, "NacreScatterInfo::irradiance"},
    {NACRE_IMAGE_DEPTH, &NacreScatterInfo::depth, "NacreScatterInfo::depth"},
    {NACRE_IMAGE_MATERIAL_ID, &NacreScatterInfo::materialId, "NacreScatterInfo::materialId"},
    {NACRE_IMAGE_NORMAL, &NacreScatterInfo::normal, "NacreScatterInfo::normal"},
    {NACRE_IMAGE_STRENGTH, &NacreScatterInfo::strength, "NacreScatterInfo::strength"},
    {NACRE_IMAGE_ALBEDO, &NacreScatterInfo::albedo, "NacreScatterInfo::albedo"},
    {NACRE_IMAGE_SCATTERED, &NacreScatterInfo::scattered, "NacreScatterInfo::scattered"},
};

/// Checks all images; returns those that are given.
ImageSet checkImages(const NacreScatterInfo& info, const VkRect2D& area) {
    ImageSet given = 0;
    for (const auto& [slot, image, field] : images) {
        given |= checkImage(info.*image, slot, area, field) ? 1u << slot : 0u;
    }
    if (info.scattered.view == info.irradiance.view) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::scattered.view is the irradiance's, must be another");
    }
    return given;
}

/// What the call asks of its passes.
Variant variantOf(ImageSet given, const MaterialTable::Summary& materials) {
    constexpr ImageSet asking = 1u << NACRE_IMAGE_ALBEDO | 1u << NACRE_IMAGE_STRENGTH;
    return (materials.haveSeparate ? separateMaterials : 0) |
           ((given & asking) != 0 || materials.havePartialStrength ? albedoOrStrength : 0);
}

void checkBakedKernel(const Context& context, const NacreScatterInfo& info) {
    if (info.technique != NACRE_TECHNIQUE_THESIS || !info.thesisBakedKernel) {
        return;
    }
    if (context.bakedThesis.empty()) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::thesisBakedKernel is ", info.thesisBakedKernel,
             ", but nacreBakeThesisKernel was not called");
    }
    if (info.thesisRadius != 0 && info.thesisRadius != context.bakedThesisRadius) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::thesisRadius is ", info.thesisRadius,
             ", the baked kernel's is ", context.bakedThesisRadius);
    }
}

void scatter(Context& context, VkCommandBuffer commandBuffer, const NacreScatterInfo& info) {
    constexpr const char* name = "NacreScatterInfo";
    const std::size_t asked = scatterTechniqueIndex(context, info.technique, "NacreScatterInfo::technique");
    const VkRect2D area = renderArea(info.view, info.irradiance.extent, context.maxExtent, name);
    const ImageSet given = checkImages(info, area);
    Record& record = nextRecord(context, info.frame, &Frame::scatter, name);
    const MaterialTable::Summary& materials = context.materials->summary(info.frame);
    const std::size_t technique = chosenTechniqueIndex(context, asked, materials);
    const ScatterParameters parameters = scatterParameters(info, given, area, materials.havePreAndPost);
    checkBakedKernel(context, info);

    // From here on nothing fails.
    std::memcpy(record.mappedParameters, &parameters, sizeof(parameters));
    DescriptorWriter descriptors(record.set);
    descriptors.uniform(bindingParameters, record.parameters);
    descriptors.storage(bindingMaterials, context.materials->parameters(info.frame));
    descriptors.storage(bindingTables, context.materials->table(info.frame, technique));
    descriptors.sampled(bindingDepth, info.depth, info.depth);
    descriptors.sampled(bindingMaterialId, info.materialId, info.materialId);
    descriptors.sampled(bindingNormal, info.normal, info.irradiance);
    descriptors.sampled(bindingStrength, info.strength, info.irradiance);
    descriptors.sampled(bindingIrradiance, info.irradiance, info.irradiance);
    descriptors.sampled(bindingAlbedo, info.albedo, info.irradiance);
    descriptors.output(bindingScattered, info.scattered);
    descriptors.intermediates(context, context.scatter.intermediates);
    descriptors.write(context.device);
    ++context.frames[info.frame].scatter.used;
    recordPasses({context, context.scatter, technique, commandBuffer, record.set, area.extent, info.timestamps,
                  techniques[technique]->uses(), materials.slotCount, variantOf(given, materials),
                  info.thesisBakedKernel != VK_FALSE});
}

} // namespace
} // namespace nacre::effect

NacreResult nacreCmdScatter(NacreContext context, VkCommandBuffer commandBuffer, const NacreScatterInfo* info) {
    using namespace nacre::effect;
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] {
        checkGiven(commandBuffer, "commandBuffer");
        checkGiven(info, "NacreScatterInfo");
        scatter(*context, commandBuffer, *info);
    });
}
