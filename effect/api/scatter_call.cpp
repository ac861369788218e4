// nacreCmdScatter: checks the arguments, fills descriptors and parameters, records the technique's passes.
#include "api/guard.hpp"
#include "baselines/baselines.hpp"
#include "contract/parameters.hpp"
#include "contract/validation.hpp"
#include "vulkan/recording.hpp"
#include "vulkan/technique_choice.hpp"

#include <cstring>

namespace nacre::effect {

namespace {

constexpr struct {
    NacreImageSlot slot;
    NacreImage NacreScatterInfo::*image;
    const char* field;
} images[] = {
    {NACRE_IMAGE_IRRADIANCE, &NacreScatterInfo::irradiance, "NacreScatterInfo::irradiance"},
    {NACRE_IMAGE_DEPTH, &NacreScatterInfo::depth, "NacreScatterInfo::depth"},
    {NACRE_IMAGE_NORMAL, &NacreScatterInfo::normal, "NacreScatterInfo::normal"},
    {NACRE_IMAGE_STRENGTH, &NacreScatterInfo::strength, "NacreScatterInfo::strength"},
    {NACRE_IMAGE_SCALE, &NacreScatterInfo::scale, "NacreScatterInfo::scale"},
    {NACRE_IMAGE_ALBEDO, &NacreScatterInfo::albedo, "NacreScatterInfo::albedo"},
    {NACRE_IMAGE_SCATTERED, &NacreScatterInfo::scattered, "NacreScatterInfo::scattered"},
};

/// Checks all images; returns those that are given.
ImageSet checkImages(const Context& context, const NacreScatterInfo& info, const VkRect2D& area) {
    ImageSet given = 0;
    for (const auto& [slot, image, field] : images) {
        given |= checkImage(info.*image, slot, area, field) ? 1u << slot : 0u;
    }
    checkMaterialId(info.materialId, context.noMaterialIds, area, "NacreScatterInfo::materialId");
    checkNormals(info.normal, context.normalEncoding, "NacreScatterInfo::normal");
    if (info.scattered.view == info.irradiance.view) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::scattered.view is the irradiance's, must be another");
    }
    return given;
}

void scatter(Context& context, VkCommandBuffer commandBuffer, const NacreScatterInfo& info) {
    constexpr const char* name = "NacreScatterInfo";
    const std::size_t asked = scatterTechniqueIndex(context, info.technique, "NacreScatterInfo::technique");
    const VkRect2D area = renderArea(info.view, info.irradiance.extent, context.maxExtent, name);
    const ImageSet given = checkImages(context, info, area);
    const std::uint32_t frame = begunFrame(context, name);
    CallResources& call = nextCall(context, frame, &Frame::scatter, name);
    const MaterialTable::Summary& materials = context.materials->summary(frame);
    const std::size_t technique = chosenTechniqueIndex(context, asked, materials);
    const ScatterParameters parameters = scatterParameters(info, given, area, materials.havePreAndPost);
    const bool baked = takesBakedKernel(context, info);

    // From here on nothing fails.
    std::memcpy(call.mappedParameters, &parameters, sizeof(parameters));
    DescriptorWriter descriptors(call.set);
    descriptors.uniform(bindingParameters, call.parameters);
    descriptors.storage(bindingMaterials, context.materials->parameters(frame));
    descriptors.storage(bindingTables, context.materials->table(frame, technique));
    descriptors.sampled(bindingDepth, info.depth, info.depth);
    const NacreImage ids = idsOf(context, info.materialId);
    descriptors.sampled(bindingMaterialId, ids, ids);
    descriptors.sampled(bindingNormal, info.normal, info.irradiance);
    descriptors.sampled(bindingStrength, info.strength, info.irradiance);
    descriptors.sampled(bindingScale, info.scale, info.irradiance);
    descriptors.sampled(bindingIrradiance, info.irradiance, info.irradiance);
    descriptors.sampled(bindingAlbedo, info.albedo, info.irradiance);
    descriptors.output(bindingScattered, info.scattered);
    descriptors.intermediates(context, context.scatter.intermediates);
    descriptors.write(context.device);
    ++context.frames[frame].scatter.used;
    recordPasses({context, context.scatter, technique, commandBuffer, call.set, area.extent, info.timestamps,
                  techniques[technique]->uses() | idsIntermediate(context), materials.slotCount,
                  scatterVariant(given, materials.haveSeparate, materials.havePartialStrength), baked});
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
