#include "nacre/material.hpp"

#include "fault.hpp"
#include "nacre/burley.hpp"
#include "nacre/gaussian.hpp"

#include <algorithm>

namespace nacre {
namespace {

Rgb scaledMeanFreePath(const Material& material) {
    Rgb d = *material.meanFreePath;
    for (double& value : d) {
        value *= material.scale;
    }
    return d;
}

std::string findProfileFault(const Material& material) {
    if (material.layers.empty() == !material.meanFreePath) {
        return material.layers.empty() ? "layers, meanFreePath and slabs are all missing, one must describe the profile"
                                       : "layers and meanFreePath are both given, only one may describe the profile";
    }
    if (!material.slabs.empty()) {
        if (material.meanFreePath) {
            return "slabs and meanFreePath are both given, only one may describe the profile";
        }
        if (auto fault = findFault(std::span<const Slab>(material.slabs)); !fault.empty()) {
            return fault;
        }
    }
    if (auto fault = findFault("scale", material.scale, scaleRange); !fault.empty()) {
        return fault;
    }
    if (material.meanFreePath) {
        auto fault = findFault("meanFreePath", *material.meanFreePath, meanFreePathRange);
        return !fault.empty() ? fault
                              : findFault("scale·meanFreePath", scaledMeanFreePath(material), meanFreePathRange);
    }
    if (auto fault = findLayerFault(material.layers); !fault.empty()) {
        return fault;
    }
    for (const Layer& layer : scaled(material.layers, material.scale)) {
        if (auto fault = findFault("scale²·variance", layer.variance, varianceRange); !fault.empty()) {
            return fault;
        }
    }
    return {};
}

} // namespace

std::unique_ptr<Profile> makeProfile(const Material& material) {
    requireNoFault(findProfileFault(material));
    if (material.meanFreePath) {
        return std::make_unique<BurleyProfile>(scaledMeanFreePath(material));
    }
    return std::make_unique<SumOfGaussiansProfile>(scaled(material.layers, material.scale));
}

std::vector<Layer> makeLayers(const Material& material) {
    requireNoFault(findProfileFault(material));
    if (material.meanFreePath) {
        return burleyLayers(scaledMeanFreePath(material));
    }
    return scaled(normalized(material.layers), material.scale);
}

bool asksForSecondSurfaces(const Material& material) {
    if (material.secondSurfaces) {
        return *material.secondSurfaces;
    }
    const std::unique_ptr<Profile> profile = makeProfile(material);
    return std::max({profile->rmsRadius(0), profile->rmsRadius(1), profile->rmsRadius(2)}) >= secondSurfacesRadius;
}

std::string findFault(const Material& material) {
    const struct {
        const char* field;
        double value;
    } shares[] = {{"strength", material.strength},
                  {"translucency", material.translucency},
                  {"diffuseTransmission", material.diffuseTransmission},
                  {"roughness", material.roughness},
                  {"specular", material.specular},
                  {"secondLobe", material.secondLobe}};
    for (const auto& share : shares) {
        if (auto fault = findFault(share.field, share.value, unitRange); !fault.empty()) {
            return fault;
        }
    }
    if (auto fault = findFault("secondLobeRoughness", material.secondLobeRoughness, lobeRoughnessRange);
        !fault.empty()) {
        return fault;
    }
    if (auto fault = findFault("albedo", material.albedo, unitRange); !fault.empty()) {
        return fault;
    }
    if (material.diffuseTransmissionColor) {
        if (auto fault = findFault("diffuseTransmissionColor", *material.diffuseTransmissionColor, unitRange);
            !fault.empty()) {
            return fault;
        }
    }
    return findProfileFault(material);
}

} // namespace nacre
