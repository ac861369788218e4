#include "nacre/presets.hpp"

#include "presets_measured.hpp"

#include <algorithm>

namespace nacre {
namespace {

Material skin() {
    Material material;
    material.name = "skin";
    material.description = "Human skin: the six Gaussians of d'Eon and Luebke 2007 (GPU Gems 3, chapter 14)";
    material.layers = {{{0.233, 0.455, 0.649}, 0.0064}, {{0.100, 0.336, 0.344}, 0.0484}, {{0.118, 0.198, 0.000}, 0.187},
                       {{0.113, 0.007, 0.007}, 0.567},  {{0.358, 0.004, 0.000}, 1.99},   {{0.078, 0.000, 0.000}, 7.41}};
    material.albedo = {0.77, 0.55, 0.45};
    material.roughness = 0.45;
    material.specular = 0.35;
    return material;
}

Material skinBurley() {
    Material material;
    material.name = "skin-burley";
    material.description = "Human skin: Burley's normalised diffusion with the widths of Jensen's Skin1";
    // Jensen's Skin1 through the searchlight fit of Christensen and Burley 2015: d = 1/(σt′·s(Rd)).
    material.meanFreePath = {0.746, 0.318, 0.175};
    material.albedo = {0.77, 0.55, 0.45};
    material.roughness = 0.45;
    material.specular = 0.35;
    return material;
}

Material marble() {
    Material material;
    material.name = "marble";
    material.description =
        "White marble: four Gaussians fitted to Jensen's dipole by Jimenez, Sundstedt and Gutierrez 2009";
    material.layers = {{{0.0544578, 0.124549, 0.217725}, 0.0362209},
                       {{0.243663, 0.243532, 0.189042}, 0.114451},
                       {{0.310530, 0.315817, 0.374245}, 0.455584},
                       {{0.391349, 0.316102, 0.218988}, 3.48332}};
    material.albedo = {0.83, 0.79, 0.75};
    material.roughness = 0.25;
    return material;
}

Material wax() {
    Material material;
    material.name = "wax";
    material.description = "Candle wax, chosen by eye";
    material.layers = {
        {{0.20, 0.30, 0.45}, 0.05}, {{0.25, 0.30, 0.35}, 0.5}, {{0.30, 0.28, 0.17}, 4}, {{0.25, 0.12, 0.03}, 20}};
    material.albedo = {0.92, 0.82, 0.62};
    material.roughness = 0.4;
    material.specular = 0.4;
    return material;
}

Material jade() {
    Material material;
    material.name = "jade";
    material.description = "Green jade, chosen by eye";
    material.layers = {
        {{0.45, 0.15, 0.30}, 0.1}, {{0.35, 0.25, 0.35}, 1}, {{0.17, 0.35, 0.27}, 6}, {{0.03, 0.25, 0.08}, 25}};
    material.albedo = {0.35, 0.72, 0.48};
    material.roughness = 0.2;
    material.specular = 0.7;
    return material;
}

Material leaf() {
    Material material;
    material.name = "leaf";
    material.description = "A green leaf a third of a millimetre thick, chosen by eye";
    material.layers = {{{0.50, 0.35, 0.60}, 0.004}, {{0.35, 0.40, 0.32}, 0.04}, {{0.15, 0.25, 0.08}, 0.25}};
    material.albedo = {0.22, 0.42, 0.08};
    material.roughness = 0.45;
    return material;
}

Material motherOfPearl() {
    Material material;
    material.name = "nacre";
    material.description = "Mother-of-pearl: ten layers whose colour shifts with depth, chosen by eye";
    material.layers = {{{0.06, 0.08, 0.10}, 0.002}, {{0.10, 0.07, 0.09}, 0.006}, {{0.07, 0.11, 0.08}, 0.02},
                       {{0.12, 0.08, 0.13}, 0.06},  {{0.08, 0.13, 0.10}, 0.18},  {{0.14, 0.10, 0.15}, 0.5},
                       {{0.11, 0.14, 0.09}, 1.4},   {{0.15, 0.12, 0.13}, 3.6},   {{0.10, 0.11, 0.09}, 9},
                       {{0.07, 0.06, 0.04}, 20}};
    material.albedo = {0.88, 0.84, 0.82};
    material.roughness = 0.18;
    material.specular = 0.7;
    return material;
}

} // namespace

std::span<const Material> presets() {
    static const std::vector<Material> all = [] {
        std::vector<Material> result{skin(), skinBurley(), marble()};
        appendMeasuredPresets(result);
        for (const Material& material : {wax(), jade(), leaf(), motherOfPearl()}) {
            result.push_back(material);
        }
        return result;
    }();
    return all;
}

const Material* findPreset(std::string_view name) {
    const std::span<const Material> all = presets();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Material& preset) { return preset.name == name; });
    return found == all.end() ? nullptr : &*found;
}

} // namespace nacre
