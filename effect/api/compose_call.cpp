// nacreCmdCompose: checks the arguments, fills descriptors and parameters, records the pass.
#include "api/guard.hpp"
#include "contract/parameters.hpp"
#include "contract/validation.hpp"
#include "vulkan/recording.hpp"

#include <cstring>

namespace nacre::effect {
namespace {

constexpr struct {
    NacreImageSlot slot;
    NacreImage NacreComposeInfo::*image;
    const char* field;
} images[] = {
    {NACRE_IMAGE_IRRADIANCE, &NacreComposeInfo::scattered, "NacreComposeInfo::scattered"},
    {NACRE_IMAGE_STRENGTH, &NacreComposeInfo::strength, "NacreComposeInfo::strength"},
    {NACRE_IMAGE_ALBEDO, &NacreComposeInfo::albedo, "NacreComposeInfo::albedo"},
    {NACRE_IMAGE_COMPOSED, &NacreComposeInfo::composed, "NacreComposeInfo::composed"},
};

/// Checks all images; returns those that are given.
ImageSet checkImages(const Context& context, const NacreComposeInfo& info, const VkRect2D& area) {
    ImageSet given = 0;
    for (const auto& [slot, image, field] : images) {
        given |= checkImage(info.*image, slot, area, field) ? 1u << slot : 0u;
    }
    if (info.transmitted.view != VK_NULL_HANDLE) {
        checkImage(info.transmitted, NACRE_IMAGE_IRRADIANCE, area, "NacreComposeInfo::transmitted");
    }
    checkMaterialId(info.materialId, context.noMaterialIds, area, "NacreComposeInfo::materialId");
    if (info.composed.view == info.scattered.view || info.composed.view == info.transmitted.view) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreComposeInfo::composed.view is that of an input, must be another");
    }
    return given;
}

void compose(Context& context, VkCommandBuffer commandBuffer, const NacreComposeInfo& info) {
    constexpr const char* name = "NacreComposeInfo";
    const NacreView view{.renderArea = info.renderArea};
    const VkRect2D area = renderArea(view, info.scattered.extent, context.maxExtent, name);
    const ScatterParameters parameters = composeParameters(info, checkImages(context, info, area), area);
    const std::uint32_t frame = begunFrame(context, name);
    CallResources& call = nextCall(context, frame, &Frame::compose, name);

    // From here on nothing fails.
    std::memcpy(call.mappedParameters, &parameters, sizeof(parameters));
    DescriptorWriter descriptors(call.set);
    descriptors.uniform(bindingParameters, call.parameters);
    descriptors.storage(bindingMaterials, context.materials->parameters(frame));
    descriptors.storage(bindingTables, context.materials->parameters(frame)); // there are none
    descriptors.sampled(bindingDepth, info.scattered, info.scattered);
    const NacreImage ids = idsOf(context, info.materialId);
    descriptors.sampled(bindingMaterialId, ids, ids);
    descriptors.sampled(bindingNormal, info.transmitted, info.scattered);
    descriptors.sampled(bindingStrength, info.strength, info.scattered);
    descriptors.sampled(bindingIrradiance, info.scattered, info.scattered);
    descriptors.sampled(bindingAlbedo, info.albedo, info.scattered);
    descriptors.output(bindingScattered, info.composed);
    descriptors.intermediates(context, context.scatter.intermediates);
    descriptors.write(context.device);
    ++context.frames[frame].compose.used;
    recordPasses({context, context.scatter, composeIndex, commandBuffer, call.set, area.extent, info.timestamps,
                  idsIntermediate(context)});
}

} // namespace
} // namespace nacre::effect

NacreResult nacreCmdCompose(NacreContext context, VkCommandBuffer commandBuffer, const NacreComposeInfo* info) {
    using namespace nacre::effect;
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] {
        checkGiven(commandBuffer, "commandBuffer");
        checkGiven(info, "NacreComposeInfo");
        compose(*context, commandBuffer, *info);
    });
}
