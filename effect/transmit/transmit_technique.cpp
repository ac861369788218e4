// Transmit: light through bodies, all lights and materials in one dispatch.
#include "technique.hpp"
#include "transmit/transmit_blocks.h"

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
/// TransmitTable::spread is the radius outside of which this share of the light leaves.
constexpr double spreadShare = 0.25;

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
    table.spread = static_cast<float>(profile.quantileRadius(1 - spreadShare));
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

constexpr Intermediate transmitIntermediates[] = {
    {.number = intermediateNoShadowMap,
     .name = "nacre no shadow map",
     .format = VK_FORMAT_R32_SFLOAT,
     .extent =
         [](VkExtent2D) {
             return VkExtent2D{1, 1};
         },
     .array = true},
};

constexpr Pass passes[] = {
    {.name = "nacre transmit",
     .file = "transmit",
     .spirv = transmit_spv,
     .reads = bit(intermediateNoShadowMap),
     .grid = tiles<8, 16>,
     .constants = severalShadowMaps | generalCall},
};

} // namespace

const Technique transmitTechnique{.name = "transmit",
                                  .intermediates = transmitIntermediates,
                                  .passes = passes,
                                  .tableBytes = sizeof(TransmitTable),
                                  .buildTable = buildTable};

} // namespace nacre::effect
