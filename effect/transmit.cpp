// Transmit: light through bodies, all lights and materials in one dispatch.
#include "record.hpp"
#include "validation.hpp"
#include "view.hpp"

#include "nacre/gaussian.hpp"

#include "transmit.spv.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace nacre::effect {
namespace {

/// The thickness at which the table ends lets this share of the light through.
constexpr double tableEndShare = 1e-4;

void setLayers(TransmitTable& table, std::span<const Layer> layers) {
    constexpr double leastVariance = 1e-12; // mm²: a point mass lets light through no thickness at all
    table.end.y = static_cast<float>(layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        table.layers[i] = toVec4(layers[i].weight, 1 / std::max(layers[i].variance, leastVariance));
    }
}

void buildTable(const Material&, const Profile& profile, std::span<std::byte> bytes) {
    TransmitTable table{};
    const double end = profile.quantileRadius(1 - tableEndShare);
    table.end = {static_cast<float>(end), 0, 0, 0};
    if (const auto* layered = dynamic_cast<const SumOfGaussiansProfile*>(&profile)) {
        setLayers(table, layered->layers());
    }
    for (std::size_t i = 0; i + 1 < transmittanceEntries; ++i) {
        const double share = static_cast<double>(i) / (transmittanceEntries - 1);
        const auto value = [&](int channel) {
            return static_cast<float>(profile.slabTransmittance(channel, end * share * share));
        };
        table.transmittance[i] = {value(0), value(1), value(2), 0};
    }
    std::memcpy(bytes.data(), &table, sizeof(table));
}

constexpr Pass passes[] = {
    {.name = "nacre transmit", .spirv = transmit_spv, .reads = bit(Intermediate::NoShadowMap), .grid = tiles<8, 8>},
};

void checkLight(const NacreLight& light, const FieldName& field, std::uint32_t shadowMapCount) {
    if (light.kind < NACRE_LIGHT_DIRECTIONAL || light.kind > NACRE_LIGHT_POINT) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".kind is ", static_cast<int>(light.kind),
             ", must be a NacreLightKind");
    }
    checkFinite(light.position, field + ".position");
    checkFinite(light.irradiance, field + ".irradiance");
    for (const float value : light.irradiance) {
        checkRange(value, 0, 3e38f, field + ".irradiance");
    }
    if (light.kind != NACRE_LIGHT_POINT) {
        checkFinite(light.direction, field + ".direction");
        if (std::hypot(light.direction[0], light.direction[1], light.direction[2]) < 1e-12f) {
            fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".direction is 0,0,0, must have a length");
        }
    }
    checkRange(light.range, 0, 3e38f, field + ".range");
    if (light.kind == NACRE_LIGHT_SPOT) {
        checkRange(light.outerConeAngle, 0, std::numbers::pi_v<float> / 2, field + ".outerConeAngle");
        checkRange(light.innerConeAngle, 0, light.outerConeAngle, field + ".innerConeAngle");
    }
    if (light.shadowMap == NACRE_NO_SHADOW_MAP) {
        return;
    }
    if (light.shadowMap >= shadowMapCount) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".shadowMap is ", light.shadowMap,
             ", NacreTransmitInfo::shadowMapCount is ", shadowMapCount);
    }
    if (!std::isfinite(light.shadowRange) || light.shadowRange <= 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".shadowRange is ", light.shadowRange, ", must be positive");
    }
    if (light.kind != NACRE_LIGHT_POINT) {
        checkFinite(light.shadowClipFromWorld, field + ".shadowClipFromWorld");
    }
}

LightParameters parametersOf(const NacreLight& light, const NacreTransmitInfo& info, float metersPerUnit) {
    LightParameters parameters{};
    std::memcpy(&parameters.shadowClipFromWorld, light.shadowClipFromWorld, sizeof(parameters.shadowClipFromWorld));
    parameters.position = {light.position[0], light.position[1], light.position[2], light.range};
    if (light.kind != NACRE_LIGHT_POINT) {
        const float length = std::hypot(light.direction[0], light.direction[1], light.direction[2]);
        parameters.direction = {light.direction[0] / length, light.direction[1] / length, light.direction[2] / length,
                                0};
    }
    parameters.direction.w = light.shadowRange;
    parameters.irradiance = {light.irradiance[0], light.irradiance[1], light.irradiance[2], metersPerUnit};
    if (light.kind == NACRE_LIGHT_SPOT) {
        const float outer = std::cos(light.outerConeAngle);
        parameters.coneScale = 1.0f / std::max(std::cos(light.innerConeAngle) - outer, 0.001f);
        parameters.coneOffset = -outer * parameters.coneScale;
    }
    parameters.kind = static_cast<uint>(light.kind);
    parameters.shadowMap = light.shadowMap;
    parameters.shadowLayer = light.shadowLayer;
    if (light.shadowMap != NACRE_NO_SHADOW_MAP) {
        const VkExtent2D size = info.shadowMaps[light.shadowMap].extent;
        parameters.shadowSize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    }
    return parameters;
}

void checkLights(const Context& context, const NacreTransmitInfo& info) {
    if (info.lightCount > context.maxLights) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, "NacreTransmitInfo::lightCount is ", info.lightCount,
             ", NacreContextInfo::maxLights is ", context.maxLights);
    }
    if (info.shadowMapCount > NACRE_MAX_SHADOW_MAPS) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, "NacreTransmitInfo::shadowMapCount is ", info.shadowMapCount, ", at most ",
             NACRE_MAX_SHADOW_MAPS);
    }
    if (info.lightCount > 0) {
        checkGiven(info.lights, "NacreTransmitInfo::lights");
    }
    if (info.shadowMapCount > 0) {
        checkGiven(info.shadowMaps, "NacreTransmitInfo::shadowMaps");
    }
    for (std::uint32_t i = 0; i < info.shadowMapCount; ++i) {
        checkShadowMap(info.shadowMaps[i], FieldName("NacreTransmitInfo::shadowMaps").at(i));
    }
    for (std::uint32_t i = 0; i < info.lightCount; ++i) {
        checkLight(info.lights[i], FieldName("NacreTransmitInfo::lights").at(i), info.shadowMapCount);
    }
}

/// Checks the images and fills everything of the parameters but the lights.
TransmitParameters checkedParameters(const NacreTransmitInfo& info, const VkRect2D& area) {
    checkImage(info.depth, NACRE_IMAGE_DEPTH, area, "NacreTransmitInfo::depth");
    checkImage(info.materialId, NACRE_IMAGE_MATERIAL_ID, area, "NacreTransmitInfo::materialId");
    if (!checkImage(info.normal, NACRE_IMAGE_NORMAL, area, "NacreTransmitInfo::normal")) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreTransmitInfo::normal.view is null, the image is required");
    }
    checkImage(info.transmitted, NACRE_IMAGE_TRANSMITTED, area, "NacreTransmitInfo::transmitted");
    TransmitParameters parameters{};
    ViewParameters& view = parameters.view;
    view.flags |= flagNormal;
    view.flags |=
        checkImage(info.thickness, NACRE_IMAGE_THICKNESS, area, "NacreTransmitInfo::thickness") ? flagThickness : 0u;
    view.flags |=
        checkImage(info.strength, NACRE_IMAGE_STRENGTH, area, "NacreTransmitInfo::strength") ? flagStrength : 0u;
    view.flags |= checkImage(info.thicknessOut, NACRE_IMAGE_THICKNESS_OUT, area, "NacreTransmitInfo::thicknessOut")
                      ? flagThicknessOut
                      : 0u;
    view.flags |= info.thesisTransmittance ? flagThesisTransmittance : 0u;
    checkFinite(std::span(&info.normalScale, 1), "NacreTransmitInfo::normalScale");
    checkFinite(std::span(&info.normalBias, 1), "NacreTransmitInfo::normalBias");
    checkRange(info.normalOffset, 0, 1000, "NacreTransmitInfo::normalOffset");
    checkRange(info.filterRadius, 0, 1000, "NacreTransmitInfo::filterRadius");
    setView(view, info.view, area, true, "NacreTransmitInfo");
    view.normalScale = info.normalScale == 0 ? 1.0f : info.normalScale;
    view.normalBias = info.normalBias;
    view.lightCount = info.lightCount;
    parameters.normalOffset = info.normalOffset == 0 ? 1.5f : info.normalOffset;
    parameters.filterRadius = info.filterRadius == 0 ? 2.0f : info.filterRadius;
    return parameters;
}

void transmit(Context& context, VkCommandBuffer commandBuffer, const NacreTransmitInfo& info) {
    const VkRect2D area = renderArea(info.view, info.depth.extent, context.maxExtent, "NacreTransmitInfo");
    const TransmitParameters parameters = checkedParameters(info, area);
    checkLights(context, info);
    Record& record = nextRecord(context, info.frame, &Frame::transmit, "NacreTransmitInfo");

    // From here on nothing fails.
    std::memcpy(record.mappedParameters, &parameters, sizeof(parameters));
    for (std::uint32_t i = 0; i < info.lightCount; ++i) {
        const LightParameters light = parametersOf(info.lights[i], info, parameters.view.mmPerUnit * 1e-3f);
        std::memcpy(record.mappedLights + i * sizeof(light), &light, sizeof(light));
    }
    NacreImage noShadowMap{};
    noShadowMap.view = context.intermediates[intermediateNoShadowMap].image.view.get();
    noShadowMap.layout = VK_IMAGE_LAYOUT_GENERAL;
    DescriptorWriter descriptors(record.set);
    descriptors.uniform(bindingParameters, record.parameters);
    descriptors.storage(bindingMaterials, context.materials->parameters(info.frame));
    descriptors.storage(bindingTables, context.materials->table(info.frame, transmitIndex));
    descriptors.storage(bindingLights, record.lights);
    descriptors.sampled(bindingDepth, info.depth, info.depth);
    descriptors.sampled(bindingMaterialId, info.materialId, info.materialId);
    descriptors.sampled(bindingNormal, info.normal, info.normal);
    descriptors.sampled(bindingStrength, info.strength, info.normal);
    descriptors.sampled(bindingThickness, info.thickness, info.normal);
    descriptors.sampledArray(bindingShadowMaps, std::span(info.shadowMaps, info.shadowMapCount), maxShadowMaps,
                             noShadowMap);
    descriptors.output(bindingTransmitted, info.transmitted);
    descriptors.output(bindingThicknessOut,
                       info.thicknessOut.view != VK_NULL_HANDLE ? info.thicknessOut : info.transmitted);
    descriptors.intermediates(context, context.transmit.intermediates);
    descriptors.write(context.device);
    ++context.frames[info.frame].transmit.used;
    recordPasses({context, context.transmit, transmitIndex, commandBuffer, record.set, area.extent, info.timestamps});
}

} // namespace

const Technique transmitTechnique{"transmit", passes, sizeof(TransmitTable), buildTable};

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
