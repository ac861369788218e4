#include "view/model/material_structs.hpp"

#include "renderer/effect_arguments.hpp"

#include <array>
#include <cctype>
#include <cstdio>
#include <vector>

namespace nacre::view {
namespace {

/// A float as C source has it, exactly.
std::string floatText(float value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", static_cast<double>(value));
    std::string result = text.data();
    if (result.find_first_of(".e") == std::string::npos) {
        result += ".0";
    }
    return result + "f";
}

std::string rgbText(const float (&values)[3]) {
    return std::string("{") + floatText(values[0]) + ", " + floatText(values[1]) + ", " + floatText(values[2]) + "}";
}

/// The name as an identifier of C: "skin by its contents" becomes skin_by_its_contents.
std::string identifierOf(const std::string& name) {
    std::string result;
    for (const char c : name) {
        result += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    }
    const bool begins = !result.empty() && std::isdigit(static_cast<unsigned char>(result.front())) == 0;
    return begins ? result : "material_" + result;
}

} // namespace

std::string structsOf(const Material& material) {
    std::vector<NacreLayer> layers;
    const NacreMaterial converted = renderer::effectMaterial(material, layers);
    const std::string name = identifierOf(material.name);
    std::string text;
    if (!layers.empty()) {
        text += "static const NacreLayer " + name + "_layers[] = {\n";
        for (const NacreLayer& layer : layers) {
            text += "    {.weight = " + rgbText(layer.weight) + ", .variance = " + floatText(layer.variance) + "},\n";
        }
        text += "};\n";
    }
    text += "static const NacreMaterial " + name + " = {\n";
    if (layers.empty()) {
        text += "    .meanFreePath = " + rgbText(converted.meanFreePath) + ",\n";
    } else {
        text += "    .layers = " + name + "_layers,\n    .layerCount = " + std::to_string(layers.size()) + ",\n";
    }
    text += std::string("    .albedoUse = ") +
            (converted.albedoUse == NACRE_ALBEDO_PRE_AND_POST ? "NACRE_ALBEDO_PRE_AND_POST" : "NACRE_ALBEDO_POST") +
            ",\n    .strength = " + floatText(converted.strength) +
            ",\n    .translucency = " + floatText(converted.translucency) +
            ",\n    .scale = " + floatText(converted.scale) + ",\n    .exchangeGroups = 0xffffffffu,\n" +
            "    .secondSurfaces = " + (converted.secondSurfaces ? "VK_TRUE" : "VK_FALSE") + ",\n};\n";
    return text;
}

} // namespace nacre::view
