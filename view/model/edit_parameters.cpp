#include "view/model/edit_parameters.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace nacre::view {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

template <int channel> Parameter<Layer> weight(const char* name, const char* label, const char* toolTip) {
    return {name,
            label,
            "",
            0,
            1,
            false,
            3,
            toolTip,
            [](const Layer& layer) { return layer.weight[channel]; },
            [](Layer& layer, double value) { layer.weight[channel] = value; }};
}

template <int axis> Parameter<scene::Light> direction(const char* name, const char* label) {
    return {name,
            label,
            "",
            -1,
            1,
            false,
            2,
            "The way the light travels",
            [](const scene::Light& light) { return double(light.direction[axis]); },
            [](scene::Light& light, double value) {
                glm::vec3 direction = light.direction;
                direction[axis] = static_cast<float>(value);
                if (glm::length(direction) > 1e-3f) {
                    light.direction = direction;
                }
            }};
}

template <int axis> Parameter<scene::Light> position(const char* name, const char* label) {
    return {name,
            label,
            "units",
            -100,
            100,
            false,
            3,
            "Where a spot or point light stands, scene units",
            [](const scene::Light& light) { return double(light.position[axis]); },
            [](scene::Light& light, double value) { light.position[axis] = static_cast<float>(value); }};
}

} // namespace

std::span<const Parameter<Material>> materialParameters() {
    static const std::array table{
        Parameter<Material>{"material.strength", "Strength", "", 0, 1, false, 2,
                            "How much of the light scatters; 0 leaves the surface as it is",
                            [](const Material& material) { return material.strength; },
                            [](Material& material, double value) { material.strength = value; }},
        Parameter<Material>{"material.translucency", "Translucency", "", 0, 1, false, 2,
                            "Multiplies the light that comes through thin parts; 1 is what the profile says",
                            [](const Material& material) { return material.translucency; },
                            [](Material& material, double value) { material.translucency = value; }},
        Parameter<Material>{"material.scale", "Scale", "×", 0.05, 20, true, 2,
                            "Multiplies every length of the profile: 2 scatters twice as far",
                            [](const Material& material) { return material.scale; },
                            [](Material& material, double value) { material.scale = value; }},
        Parameter<Material>{"material.roughness", "Roughness", "", 0, 1, false, 2,
                            "Of the specular reflection: 0 is a mirror",
                            [](const Material& material) { return material.roughness; },
                            [](Material& material, double value) { material.roughness = value; }},
        Parameter<Material>{"material.specular", "Specular", "", 0, 1, false, 2,
                            "Reflectance at normal incidence is 0.08 times this; 0.5 is an index of 1.5",
                            [](const Material& material) { return material.specular; },
                            [](Material& material, double value) { material.specular = value; }},
        Parameter<Material>{"material.secondLobe", "Second lobe", "", 0, 1, false, 2,
                            "Share of the reflection that a second lobe has, as the oil on skin makes one; 0: one lobe",
                            [](const Material& material) { return material.secondLobe; },
                            [](Material& material, double value) { material.secondLobe = value; }},
        Parameter<Material>{"material.secondLobeRoughness", "Its roughness", "×", 0, 4, false, 2,
                            "Of the second lobe: multiplies the roughness of the first",
                            [](const Material& material) { return material.secondLobeRoughness; },
                            [](Material& material, double value) { material.secondLobeRoughness = value; }},
        Parameter<Material>{"material.thinWall", "Thin wall", "", 0, 1, false, 2,
                            "Share of light that a sheet without an inside lets through; 0 is a closed body",
                            [](const Material& material) { return material.diffuseTransmission; },
                            [](Material& material, double value) { material.diffuseTransmission = value; }}};
    return table;
}

std::span<const Parameter<Layer>> layerParameters() {
    static const std::array table{
        weight<0>("layer.red", "Red", "Share of red light that this layer spreads; shares are normalised"),
        weight<1>("layer.green", "Green", "Share of green light that this layer spreads; shares are normalised"),
        weight<2>("layer.blue", "Blue", "Share of blue light that this layer spreads; shares are normalised"),
        Parameter<Layer>{"layer.variance", "Variance", "mm²", 1e-4, 1000, true, 4,
                         "How wide the layer's Gaussian is along one axis",
                         [](const Layer& layer) { return layer.variance; },
                         [](Layer& layer, double value) { layer.variance = value; }},
        Parameter<Layer>{"layer.radius", "Radius", "mm", 0.0142, 44.72, true, 3,
                         "Root mean square distance that the layer's light travels: √(2 · variance)",
                         [](const Layer& layer) { return radiusOf(layer.variance); },
                         [](Layer& layer, double value) { layer.variance = varianceOf(value); }}};
    return table;
}

std::span<const Parameter<scene::Light>> lightParameters() {
    static const std::array table{
        Parameter<scene::Light>{"light.intensity", "Intensity", "", 0.001, 1000, true, 3,
                                "Irradiance on a surface that faces the light; of a spot or point light at one metre",
                                [](const scene::Light& light) { return double(light.intensity); },
                                [](scene::Light& light, double value) { light.intensity = static_cast<float>(value); }},
        direction<0>("light.directionX", "Direction X"),
        direction<1>("light.directionY", "Direction Y"),
        direction<2>("light.directionZ", "Direction Z"),
        position<0>("light.positionX", "Position X"),
        position<1>("light.positionY", "Position Y"),
        position<2>("light.positionZ", "Position Z"),
        Parameter<scene::Light>{"light.cone", "Cone", "°", 1, 89, false, 1,
                                "Half the angle of a spot's cone; its soft edge begins at three quarters of it",
                                [](const scene::Light& light) { return light.outerConeAngle * degrees; },
                                [](scene::Light& light, double value) {
                                    light.outerConeAngle = static_cast<float>(value / degrees);
                                    light.innerConeAngle = 0.75f * light.outerConeAngle;
                                }}};
    return table;
}

std::span<const Parameter<EditedScene>> sceneParameters() {
    static const std::array table{
        Parameter<EditedScene>{
            "scene.exposure", "Exposure", "EV", -8, 8, false, 2, "The picture is multiplied by two to this power",
            [](const EditedScene& scene) { return double(scene.exposureStops); },
            [](EditedScene& scene, double value) { scene.exposureStops = static_cast<float>(value); }},
        Parameter<EditedScene>{
            "scene.environmentIntensity", "Environment", "×", 0, 4, false, 2,
            "Multiplies the light of the surroundings",
            [](const EditedScene& scene) { return double(scene.environmentIntensity); },
            [](EditedScene& scene, double value) { scene.environmentIntensity = static_cast<float>(value); }},
        Parameter<EditedScene>{
            "scene.environmentRotation", "Rotation", "°", -180, 180, false, 1,
            "Turns the surroundings about the vertical",
            [](const EditedScene& scene) { return scene.environmentRotation * degrees; },
            [](EditedScene& scene, double value) { scene.environmentRotation = static_cast<float>(value / degrees); }}};
    return table;
}

double radiusOf(double variance) {
    return std::sqrt(2 * variance);
}

double varianceOf(double radius) {
    return radius * radius / 2;
}

} // namespace nacre::view
