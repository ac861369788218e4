// A material of the core (a preset, or one from a file) as nacreSetMaterials takes it. Header only.
#pragma once

#include "nacre/material.hpp"
#include "nacre/nacre.h"

#include <algorithm>
#include <vector>

namespace nacre {

/// The C API's material. Its layers become those of `layers`, which has to live until nacreSetMaterials. Where light
/// goes through a sheet (Material::diffuseTransmission) it is a thin wall.
inline NacreMaterial callMaterial(const Material& material, std::vector<NacreLayer>& layers) {
    const auto toFloat = [](double value) { return static_cast<float>(value); };
    layers.clear();
    for (const Layer& layer : material.layers) {
        NacreLayer& converted = layers.emplace_back();
        std::transform(layer.weight.begin(), layer.weight.end(), converted.weight, toFloat);
        converted.variance = toFloat(layer.variance);
    }
    NacreMaterial result = nacreDefaultMaterial();
    result.layers = layers.data();
    result.layerCount = static_cast<std::uint32_t>(layers.size());
    if (material.meanFreePath) {
        std::transform(material.meanFreePath->begin(), material.meanFreePath->end(), result.meanFreePath, toFloat);
    }
    result.albedoUse = material.albedoUse == AlbedoUse::PreAndPost ? NACRE_ALBEDO_PRE_AND_POST : NACRE_ALBEDO_POST;
    result.strength = toFloat(material.strength);
    const bool isWall = material.diffuseTransmission > 0;
    result.translucency = toFloat(material.translucency * (isWall ? material.diffuseTransmission : 1));
    result.thinWall = isWall ? VK_TRUE : VK_FALSE;
    result.scale = toFloat(material.scale);
    result.secondSurfaces = asksForSecondSurfaces(material) ? VK_TRUE : VK_FALSE;
    return result;
}

} // namespace nacre
