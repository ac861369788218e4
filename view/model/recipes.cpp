#include "view/model/recipes.hpp"

#include "nacre/layering.hpp"

#include <algorithm>
#include <array>

namespace nacre::view {
namespace {

constexpr double dermisThickness = 1000; // mm: as good as without an end
constexpr double dermisWater = 0.65;

/// A row of a recipe's table.
template <typename Recipe, double Recipe::*member>
Parameter<Recipe> row(const char* name, const char* label, const char* unit, double low, double high, bool logarithmic,
                      const char* toolTip) {
    return {name,
            label,
            unit,
            low,
            high,
            logarithmic,
            3,
            toolTip,
            [](const Recipe& recipe) { return recipe.*member; },
            [](Recipe& recipe, double value) { recipe.*member = value; }};
}

/// A coefficient of one channel, 1/mm.
template <Rgb Medium::*coefficient, std::size_t channel>
Parameter<Slab> coefficientRow(const char* name, const char* label, double low, const char* toolTip) {
    return {name,
            label,
            "/mm",
            low,
            1000,
            true,
            4,
            toolTip,
            [](const Slab& slab) { return (slab.medium.*coefficient)[channel]; },
            [](Slab& slab, double value) {
                (slab.medium.*coefficient)[channel] = value;
                slab.skin.reset();
            }};
}

/// A share of what skin contains.
template <double SkinContent::*member>
Parameter<Slab> contentRow(const char* name, const char* label, double high, const char* toolTip) {
    return {name,
            label,
            "",
            0,
            high,
            false,
            3,
            toolTip,
            [](const Slab& slab) { return slab.skin.value_or(SkinContent{}).*member; },
            [](Slab& slab, double value) {
                SkinContent content = slab.skin.value_or(SkinContent{});
                content.*member = value;
                slab = makeSkinSlab(content, slab.thickness);
            }};
}

} // namespace

std::vector<Slab> skinSlabs(const SkinRecipe& recipe) {
    return {makeSkinSlab({.melanin = recipe.melanin, .eumelanin = recipe.eumelanin}, recipe.epidermis),
            makeSkinSlab({.haemoglobin = recipe.haemoglobin, .oxygenation = recipe.oxygenation, .water = dermisWater},
                         dermisThickness)};
}

Material mixSkin(const SkinRecipe& recipe) {
    Material material{.name = "skin by its contents",
                      .description = "Skin by melanin and blood: two slabs, epidermis over dermis"};
    material.roughness = 0.45;
    return mixSlabs(material, skinSlabs(recipe));
}

std::span<const Parameter<SkinRecipe>> skinParameters() {
    using R = SkinRecipe;
    static const std::array table{
        row<R, &R::melanin>("skin.melanin", "&Melanin", "", 0, 0.6, false,
                            "Share of the epidermis: 0.01 is fair, 0.4 very dark"),
        row<R, &R::eumelanin>("skin.eumelanin", "&Eumelanin", "", 0, 1, false,
                              "Brown and black share of the melanin; the rest is red and yellow"),
        row<R, &R::haemoglobin>("skin.haemoglobin", "&Blood", "", 0, 0.2, false,
                                "Share of the dermis that is blood: 0.002 to 0.07"),
        row<R, &R::oxygenation>("skin.oxygenation", "&Oxygenation", "", 0, 1, false,
                                "Share of the haemoglobin that carries oxygen"),
        row<R, &R::epidermis>("skin.epidermis", "E&pidermis", "mm", 0.02, 1, true, "Thickness of the epidermis")};
    return table;
}

Material mixMedium(const MediumRecipe& recipe) {
    Material material{.name = "medium",
                      .description = "Burley's profile by colour and mean free path, as OpenPBR has it"};
    material.albedo = {recipe.red, recipe.green, recipe.blue};
    constexpr double leastRadius = 1e-4; // mm
    const Rgb radius{std::max(recipe.radius * recipe.radiusRed, leastRadius),
                     std::max(recipe.radius * recipe.radiusGreen, leastRadius),
                     std::max(recipe.radius * recipe.radiusBlue, leastRadius)};
    material.meanFreePath = burleyMeanFreePath(material.albedo, radius, recipe.anisotropy);
    return material;
}

std::span<const Parameter<MediumRecipe>> mediumParameters() {
    using R = MediumRecipe;
    static const std::array table{
        row<R, &R::red>("medium.red", "Colour, &red", "", 0, 1, false, "Diffuse albedo, linear"),
        row<R, &R::green>("medium.green", "Colour, &green", "", 0, 1, false, "Diffuse albedo, linear"),
        row<R, &R::blue>("medium.blue", "Colour, &blue", "", 0, 1, false, "Diffuse albedo, linear"),
        row<R, &R::radius>("medium.radius", "&Mean free path", "mm", 0.01, 100, true, "OpenPBR's subsurface_radius"),
        row<R, &R::radiusRed>("medium.radiusRed", "Scale, r&ed", "", 0, 1, false, "OpenPBR's subsurface_radius_scale"),
        row<R, &R::radiusGreen>("medium.radiusGreen", "Scale, gree&n", "", 0, 1, false,
                                "OpenPBR's subsurface_radius_scale"),
        row<R, &R::radiusBlue>("medium.radiusBlue", "Scale, b&lue", "", 0, 1, false,
                               "OpenPBR's subsurface_radius_scale"),
        row<R, &R::anisotropy>("medium.anisotropy", "&Anisotropy", "", -0.9, 0.9, false,
                               "Of Henyey and Greenstein: above 0 light goes on forwards")};
    return table;
}

std::span<const Parameter<Slab>> slabParameters() {
    constexpr const char* scattering = "Reduced scattering: how often light is turned back, per mm";
    constexpr const char* absorption = "How much light is lost, per mm";
    static const std::array table{
        row<Slab, &Slab::thickness>("slab.thickness", "&Thickness", "mm", 0.001, 1000, true,
                                    "Of this slab; 1000 is as good as without an end"),
        Parameter<Slab>{"slab.refractiveIndex", "&Index", "", 1, 2.5, false, 3, "Refractive index; air is 1",
                        [](const Slab& slab) { return slab.medium.refractiveIndex; },
                        [](Slab& slab, double value) { slab.medium.refractiveIndex = value; }},
        coefficientRow<&Medium::reducedScattering, 0>("slab.scatteringRed", "Scattering, red", 1e-3, scattering),
        coefficientRow<&Medium::reducedScattering, 1>("slab.scatteringGreen", "Scattering, green", 1e-3, scattering),
        coefficientRow<&Medium::reducedScattering, 2>("slab.scatteringBlue", "Scattering, blue", 1e-3, scattering),
        coefficientRow<&Medium::absorption, 0>("slab.absorptionRed", "Absorption, red", 1e-4, absorption),
        coefficientRow<&Medium::absorption, 1>("slab.absorptionGreen", "Absorption, green", 1e-4, absorption),
        coefficientRow<&Medium::absorption, 2>("slab.absorptionBlue", "Absorption, blue", 1e-4, absorption),
        contentRow<&SkinContent::melanin>("slab.melanin", "&Melanin", 0.6,
                                          "Makes it skin: the melanosomes' share of the volume"),
        contentRow<&SkinContent::haemoglobin>("slab.haemoglobin", "&Blood", 0.2,
                                              "Makes it skin: the blood's share of the volume"),
        contentRow<&SkinContent::oxygenation>("slab.oxygenation", "&Oxygenation", 1,
                                              "Makes it skin: share of the haemoglobin that carries oxygen")};
    return table;
}

Material mixSlabs(Material material, std::vector<Slab> slabs) {
    material.meanFreePath.reset();
    describeBySlabs(material, std::move(slabs));
    return material;
}

} // namespace nacre::view
