#include "contract/material_check.hpp"

#include "contract/effect_error.hpp"

#include <cmath>
#include <string>

namespace nacre::effect {
namespace {

std::string ofMaterial(std::uint32_t id) {
    return id == 0 ? "" : " of material " + std::to_string(id);
}

std::string fieldName(std::uint32_t id, const std::string& field) {
    return "NacreMaterial::" + field + ofMaterial(id);
}

/// The library's material of the caller's; checks what core cannot see.
Material convert(const NacreMaterial& from, std::uint32_t id) {
    if (from.layerCount > NACRE_MAX_LAYERS) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, fieldName(id, "layerCount"), " is ", from.layerCount, ", at most ",
             NACRE_MAX_LAYERS);
    }
    if (from.layerCount > 0 && !from.layers) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, fieldName(id, "layers"), " is null, layerCount is ", from.layerCount);
    }
    if (from.albedoUse != NACRE_ALBEDO_POST && from.albedoUse != NACRE_ALBEDO_PRE_AND_POST) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, fieldName(id, "albedoUse"), " is ", static_cast<int>(from.albedoUse));
    }
    if (!std::isfinite(from.thickness) || from.thickness < 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, fieldName(id, "thickness"), " is ", from.thickness,
             " mm, must be finite and not negative");
    }
    Material material;
    for (const NacreLayer& layer : std::span(from.layers, from.layerCount)) {
        material.layers.push_back({{layer.weight[0], layer.weight[1], layer.weight[2]}, layer.variance});
    }
    if (from.layerCount == 0) {
        material.meanFreePath = {from.meanFreePath[0], from.meanFreePath[1], from.meanFreePath[2]};
    }
    material.strength = from.strength;
    material.translucency = from.translucency;
    material.scale = from.scale == 0 ? 1 : from.scale;
    if (const std::string fault = findFault(material); !fault.empty()) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreMaterial", ofMaterial(id), ": ", fault);
    }
    return material;
}

MaterialParameters parametersOf(const NacreMaterial& from, const Profile& profile) {
    MaterialParameters parameters{};
    parameters.radius = static_cast<float>(profile.quantileRadius(radiusShare));
    parameters.strength = from.strength;
    parameters.translucency = from.translucency;
    parameters.thickness = from.thickness;
    parameters.exchangeGroups = from.exchangeGroups;
    parameters.preAndPost = from.albedoUse == NACRE_ALBEDO_PRE_AND_POST;
    parameters.thinWall = from.thinWall != VK_FALSE;
    parameters.secondSurfaces = from.secondSurfaces != VK_FALSE;
    return parameters;
}

} // namespace

CheckedMaterial checkMaterial(const NacreMaterial& from, std::uint32_t id) {
    CheckedMaterial checked;
    checked.material = convert(from, id);
    checked.profile = makeProfile(checked.material);
    checked.parameters = parametersOf(from, *checked.profile);
    return checked;
}

} // namespace nacre::effect
