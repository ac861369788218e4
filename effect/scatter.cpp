// nacreCmdScatter: checks the arguments, fills descriptors and parameters, records the technique's passes.
#include "record.hpp"
#include "validation.hpp"
#include "view.hpp"

#include <cmath>
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

namespace {

/// A step of one pixel is rayX·z + originX, and proportional to clip w.
float pixelWidth(const ViewParameters& view) {
    const bool perspective = view.clipW.x != 0;
    const vec2 x = perspective ? view.rayX : view.originX;
    const vec2 y = perspective ? view.rayY : view.originY;
    return std::sqrt(std::abs(x.x * y.y - x.y * y.x)) / std::abs(perspective ? view.clipW.x : view.clipW.y);
}

void setTechnique(ScatterParameters& parameters, const Context& context, const NacreScatterInfo& info) {
    constexpr std::uint32_t defaultBudget = 64;
    constexpr std::uint32_t largestBudget = 256;
    if (info.burleySampleBudget > largestBudget) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::burleySampleBudget is ", info.burleySampleBudget,
             ", must be in [1, ", largestBudget, "]");
    }
    parameters.burleySampleBudget = info.burleySampleBudget == 0 ? defaultBudget : info.burleySampleBudget;
    parameters.burleyRotation = info.burleyRotation;
    constexpr float defaultThesisStrength = 0.1f;
    checkRange(info.thesisStrength, 0, 1e6f, "NacreScatterInfo::thesisStrength");
    parameters.thesisStrength = info.thesisStrength == 0 ? defaultThesisStrength : info.thesisStrength;
    parameters.thesisRadius = thesisRadius(info.thesisRadius, "NacreScatterInfo::thesisRadius");
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
    const std::size_t technique = scatterTechniqueIndex(context, info.technique, "NacreScatterInfo::technique");
    const VkRect2D area = renderArea(info.view, info.irradiance.extent, context.maxExtent, name);
    checkImage(info.irradiance, NACRE_IMAGE_IRRADIANCE, area, "NacreScatterInfo::irradiance");
    checkImage(info.depth, NACRE_IMAGE_DEPTH, area, "NacreScatterInfo::depth");
    checkImage(info.materialId, NACRE_IMAGE_MATERIAL_ID, area, "NacreScatterInfo::materialId");
    checkImage(info.scattered, NACRE_IMAGE_SCATTERED, area, "NacreScatterInfo::scattered");
    if (info.scattered.view == info.irradiance.view) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreScatterInfo::scattered.view is the irradiance's, must be another");
    }
    ScatterParameters parameters{};
    ViewParameters& view = parameters.view;
    const bool hasNormal = checkImage(info.normal, NACRE_IMAGE_NORMAL, area, "NacreScatterInfo::normal");
    view.flags |= hasNormal ? flagNormal : 0u;
    view.flags |=
        checkImage(info.strength, NACRE_IMAGE_STRENGTH, area, "NacreScatterInfo::strength") ? flagStrength : 0u;
    view.flags |= checkImage(info.albedo, NACRE_IMAGE_ALBEDO, area, "NacreScatterInfo::albedo") ? flagAlbedo : 0u;
    checkFinite(std::span(&info.normalScale, 1), "NacreScatterInfo::normalScale");
    checkFinite(std::span(&info.normalBias, 1), "NacreScatterInfo::normalBias");
    setView(view, info.view, area, hasNormal, name);
    view.normalScale = info.normalScale == 0 ? 1.0f : info.normalScale;
    view.normalBias = info.normalBias;
    view.flags |= context.materials->haveSeparate(info.frame) ? flagSeparateMaterials : 0u;
    parameters.pixelWidth = pixelWidth(view);
    setTechnique(parameters, context, info);
    setBankLevels(parameters, area.extent);
    Record& record = nextRecord(context, info.frame, &Frame::scatter, name);

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
                  context.materials->slotCount(info.frame), (view.flags & flagSeparateMaterials) != 0,
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
