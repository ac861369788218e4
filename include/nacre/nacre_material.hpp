// A material of the core (a preset, or one from a file) as nacreSetMaterials takes it. Header only.
#pragma once

#include "nacre/material.hpp"
#include "nacre/nacre.h"

#include <vector>

namespace nacre {

/// Owns the layers that `value` points to. Neither copied nor moved.
struct CallMaterial {
    explicit CallMaterial(const Material& material) : value(nacreDefaultMaterial()) {
        for (const Layer& layer : material.layers) {
            layers_.push_back(
                {{float(layer.weight[0]), float(layer.weight[1]), float(layer.weight[2])}, float(layer.variance)});
        }
        value.layers = layers_.data();
        value.layerCount = static_cast<std::uint32_t>(layers_.size());
        for (int channel = 0; material.meanFreePath && channel < 3; ++channel) {
            value.meanFreePath[channel] = float((*material.meanFreePath)[static_cast<std::size_t>(channel)]);
        }
        value.albedoUse = material.albedoUse == AlbedoUse::PreAndPost ? NACRE_ALBEDO_PRE_AND_POST : NACRE_ALBEDO_POST;
        value.strength = float(material.strength);
        const bool isWall = material.diffuseTransmission > 0;
        value.translucency = float(material.translucency * (isWall ? material.diffuseTransmission : 1));
        value.thinWall = isWall ? VK_TRUE : VK_FALSE;
        value.scale = float(material.scale);
        value.secondSurfaces = asksForSecondSurfaces(material) ? VK_TRUE : VK_FALSE;
    }
    CallMaterial(const CallMaterial&) = delete;
    CallMaterial& operator=(const CallMaterial&) = delete;

    NacreMaterial value;

private:
    std::vector<NacreLayer> layers_;
};

} // namespace nacre
