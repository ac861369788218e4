// nacreCmdTransmit: checks the arguments, fills descriptors, parameters and lights, records the pass.
#include "api/guard.hpp"
#include "contract/parameters.hpp"
#include "contract/validation.hpp"
#include "transmit/light_parameters.hpp"
#include "vulkan/recording.hpp"

#include <cstring>

namespace nacre::effect {
namespace {

constexpr struct {
    NacreImageSlot slot;
    NacreImage NacreTransmitInfo::*image;
    const char* field;
} images[] = {
    {NACRE_IMAGE_DEPTH, &NacreTransmitInfo::depth, "NacreTransmitInfo::depth"},
    {NACRE_IMAGE_NORMAL, &NacreTransmitInfo::normal, "NacreTransmitInfo::normal"},
    {NACRE_IMAGE_THICKNESS, &NacreTransmitInfo::thickness, "NacreTransmitInfo::thickness"},
    {NACRE_IMAGE_STRENGTH, &NacreTransmitInfo::strength, "NacreTransmitInfo::strength"},
    {NACRE_IMAGE_SCALE, &NacreTransmitInfo::scale, "NacreTransmitInfo::scale"},
    {NACRE_IMAGE_TRANSMITTED, &NacreTransmitInfo::transmitted, "NacreTransmitInfo::transmitted"},
    {NACRE_IMAGE_THICKNESS_OUT, &NacreTransmitInfo::thicknessOut, "NacreTransmitInfo::thicknessOut"},
};

/// Checks all images but the shadow maps; returns those that are given.
ImageSet checkImages(const Context& context, const NacreTransmitInfo& info, const VkRect2D& area) {
    ImageSet given = 0;
    for (const auto& [slot, image, field] : images) {
        given |= checkImage(info.*image, slot, area, field) ? 1u << slot : 0u;
    }
    checkMaterialId(info.materialId, context.noMaterialIds, area, "NacreTransmitInfo::materialId");
    checkNormals(info.normal, context.normalEncoding, "NacreTransmitInfo::normal");
    if ((given >> NACRE_IMAGE_NORMAL & 1u) == 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::normal.view is null, the image is required");
    }
    return given;
}

void checkLightsAndMaps(const Context& context, const NacreTransmitInfo& info) {
    if (info.lightCount > context.maxLights) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, "NacreTransmitInfo::lightCount is ", info.lightCount,
             ", NacreContextInfo::maxLights is ", context.maxLights);
    }
    checkLights(info);
    if (const std::uint32_t elements = lightElementCount(info); elements > context.maxLights) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, "NacreTransmitInfo::lights have ", elements - info.lightCount,
             " cascades, with the ", info.lightCount, " lights these are ", elements,
             "; NacreContextInfo::maxLights is ", context.maxLights);
    }
    for (std::uint32_t i = 0; i < info.shadowMapCount; ++i) {
        checkShadowMap(info.shadowMaps[i], FieldName("NacreTransmitInfo::shadowMaps").at(i));
    }
}

void transmit(Context& context, VkCommandBuffer commandBuffer, const NacreTransmitInfo& info) {
    const VkRect2D area = renderArea(info.view, info.depth.extent, context.maxExtent, "NacreTransmitInfo");
    const ImageSet given = checkImages(context, info, area);
    const TransmitParameters parameters = transmitParameters(info, given, area);
    checkLightsAndMaps(context, info);
    const std::uint32_t frame = begunFrame(context, "NacreTransmitInfo");
    CallResources& call = nextCall(context, frame, &Frame::transmit, "NacreTransmitInfo");

    // From here on nothing fails.
    std::memcpy(call.mappedParameters, &parameters, sizeof(parameters));
    fillLights(info, call.mappedLights);
    const std::span maps(info.shadowMaps, info.shadowMapCount);
    const NacreImage noMap{.view = context.intermediates[intermediateNoShadowMap].image.view.get(),
                           .layout = VK_IMAGE_LAYOUT_GENERAL};
    DescriptorWriter descriptors(call.set);
    descriptors.uniform(bindingParameters, call.parameters);
    descriptors.storage(bindingMaterials, context.materials->parameters(frame));
    descriptors.storage(bindingTables, context.materials->table(frame, transmitIndex));
    descriptors.storage(bindingLights, call.lights);
    descriptors.sampled(bindingDepth, info.depth, info.depth);
    const NacreImage ids = idsOf(context, info.materialId);
    descriptors.sampled(bindingMaterialId, ids, ids);
    descriptors.sampled(bindingNormal, info.normal, info.normal);
    descriptors.sampled(bindingStrength, info.strength, info.normal);
    descriptors.sampled(bindingScale, info.scale, info.normal);
    descriptors.sampled(bindingThickness, info.thickness, info.normal);
    descriptors.sampledArray(bindingShadowMaps, maps, maxShadowMaps, maps.empty() ? noMap : maps.front());
    descriptors.output(bindingTransmitted, info.transmitted);
    descriptors.output(bindingThicknessOut,
                       info.thicknessOut.view != VK_NULL_HANDLE ? info.thicknessOut : info.transmitted);
    descriptors.intermediates(context, context.transmit.intermediates);
    descriptors.write(context.device);
    ++context.frames[frame].transmit.used;
    recordPasses({context, context.transmit, transmitIndex, commandBuffer, call.set, area.extent, info.timestamps,
                  (maps.empty() ? transmitTechnique.uses() : 0) | idsIntermediate(context), 0, variantOf(info, given)});
}

} // namespace
} // namespace nacre::effect

NacreResult nacreCmdTransmit(NacreContext context, VkCommandBuffer commandBuffer, const NacreTransmitInfo* info) {
    using namespace nacre::effect;
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] {
        checkGiven(commandBuffer, "commandBuffer");
        checkGiven(info, "NacreTransmitInfo");
        transmit(*context, commandBuffer, *info);
    });
}
