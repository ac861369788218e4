// Transmit: light through bodies, all lights and materials in one dispatch.
#include "contract/parameters.hpp"
#include "contract/validation.hpp"
#include "vulkan/recording.hpp"

#include "core/half.hpp"
#include "nacre/gaussian.hpp"

#include "transmit.spv.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace nacre::effect {
namespace {

/// The thickness at which the table ends lets this share of the light through.
constexpr double tableEndShare = 1e-4;

void setLayers(TransmitTable& table, std::span<const Layer> layers) {
    constexpr double leastVariance = 1e-12; // mm²: a point mass lets light through no thickness at all
    table.layerCount = static_cast<uint>(layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        table.layers[i] = toVec4(layers[i].weight, 1 / std::max(layers[i].variance, leastVariance));
    }
}

void buildTable(const Material&, const Profile& profile, std::span<std::byte> bytes) {
    TransmitTable table{};
    const double end = profile.quantileRadius(1 - tableEndShare);
    const double scale = transmittanceEnd / end;
    table.scale = static_cast<float>(scale);
    if (const auto* layered = dynamic_cast<const SumOfGaussiansProfile*>(&profile)) {
        setLayers(table, layered->layers());
    }
    constexpr uint perOctave = 1u << transmittanceMantissaBits;
    for (uint i = 0; i < transmittanceLast; ++i) {
        const double mantissa = 1 + static_cast<double>(i % perOctave) / perOctave;
        const double thickness = (std::ldexp(mantissa, static_cast<int>(i / perOctave)) - 1) / scale;
        const auto half = [&](int channel) {
            return uint{toHalf(static_cast<float>(profile.slabTransmittance(channel, thickness)))};
        };
        table.transmittance[i] = {half(0) | half(1) << 16, half(2)};
    }
    std::memcpy(bytes.data(), &table, sizeof(table));
}

constexpr Pass passes[] = {
    {.name = "nacre transmit",
     .file = "transmit",
     .spirv = transmit_spv,
     .reads = bit(Intermediate::NoShadowMap),
     .grid = tiles<8, 16>,
     .asksShadowMaps = true},
};

constexpr struct {
    NacreImageSlot slot;
    NacreImage NacreTransmitInfo::*image;
    const char* field;
} images[] = {
    {NACRE_IMAGE_DEPTH, &NacreTransmitInfo::depth, "NacreTransmitInfo::depth"},
    {NACRE_IMAGE_MATERIAL_ID, &NacreTransmitInfo::materialId, "NacreTransmitInfo::materialId"},
    {NACRE_IMAGE_NORMAL, &NacreTransmitInfo::normal, "NacreTransmitInfo::normal"},
    {NACRE_IMAGE_THICKNESS, &NacreTransmitInfo::thickness, "NacreTransmitInfo::thickness"},
    {NACRE_IMAGE_STRENGTH, &NacreTransmitInfo::strength, "NacreTransmitInfo::strength"},
    {NACRE_IMAGE_TRANSMITTED, &NacreTransmitInfo::transmitted, "NacreTransmitInfo::transmitted"},
    {NACRE_IMAGE_THICKNESS_OUT, &NacreTransmitInfo::thicknessOut, "NacreTransmitInfo::thicknessOut"},
};

/// Checks all images but the shadow maps; returns those that are given.
ImageSet checkImages(const NacreTransmitInfo& info, const VkRect2D& area) {
    ImageSet given = 0;
    for (const auto& [slot, image, field] : images) {
        given |= checkImage(info.*image, slot, area, field) ? 1u << slot : 0u;
    }
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
    for (std::uint32_t i = 0; i < info.shadowMapCount; ++i) {
        checkShadowMap(info.shadowMaps[i], FieldName("NacreTransmitInfo::shadowMaps").at(i));
    }
}

void transmit(Context& context, VkCommandBuffer commandBuffer, const NacreTransmitInfo& info) {
    const VkRect2D area = renderArea(info.view, info.depth.extent, context.maxExtent, "NacreTransmitInfo");
    const ImageSet given = checkImages(info, area);
    const TransmitParameters parameters = transmitParameters(info, given, area);
    checkLightsAndMaps(context, info);
    Record& record = nextRecord(context, info.frame, &Frame::transmit, "NacreTransmitInfo");

    // From here on nothing fails.
    std::memcpy(record.mappedParameters, &parameters, sizeof(parameters));
    fillLights(info, record.mappedLights);
    const std::span maps(info.shadowMaps, info.shadowMapCount);
    const NacreImage noMap{.view = context.intermediates[intermediateNoShadowMap].image.view.get(),
                           .layout = VK_IMAGE_LAYOUT_GENERAL};
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
    descriptors.sampledArray(bindingShadowMaps, maps, maxShadowMaps, maps.empty() ? noMap : maps.front());
    descriptors.output(bindingTransmitted, info.transmitted);
    descriptors.output(bindingThicknessOut,
                       info.thicknessOut.view != VK_NULL_HANDLE ? info.thicknessOut : info.transmitted);
    descriptors.intermediates(context, context.transmit.intermediates);
    descriptors.write(context.device);
    ++context.frames[info.frame].transmit.used;
    recordPasses({context, context.transmit, transmitIndex, commandBuffer, record.set, area.extent, info.timestamps,
                  maps.empty() ? transmitTechnique.uses() : 0, 0, maps.size() > 1 ? severalShadowMaps : 0});
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
