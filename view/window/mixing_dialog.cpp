#include "view/window/mixing_dialog.hpp"

#include "nacre/layering.hpp"
#include "nacre/media.hpp"
#include "view/window/parameter_panel.hpp"

#include <QDialog>
#include <QDialogButtonBox>
#include <QVBoxLayout>

#include <algorithm>
#include <array>

namespace nacre::view {
namespace {

constexpr double dermisThickness = 1000; // mm: as good as without an end

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

template <typename Recipe>
std::optional<Recipe> ask(QWidget* parent, const QString& title, std::span<const Parameter<Recipe>> table) {
    Recipe recipe;
    QDialog dialog(parent);
    dialog.setWindowTitle(title);
    dialog.setMinimumWidth(420);
    auto* layout = new QVBoxLayout(&dialog);
    auto* panel = new ParameterPanel<Recipe>(table);
    panel->onChange = [&](const Parameter<Recipe>& parameter, double value) { parameter.set(recipe, value); };
    panel->show(recipe);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    layout->addWidget(panel);
    layout->addWidget(buttons);
    QObject::connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    return dialog.exec() == QDialog::Accepted ? std::optional(recipe) : std::nullopt;
}

} // namespace

Material mixSkin(const SkinRecipe& recipe) {
    Material material{.name = "skin by its contents",
                      .description = "Skin by melanin and blood: two slabs, epidermis over dermis"};
    const Slab epidermis = makeSkinSlab({.melanin = recipe.melanin, .eumelanin = recipe.eumelanin}, recipe.epidermis);
    const Slab dermis = makeSkinSlab(
        {.haemoglobin = recipe.haemoglobin, .oxygenation = recipe.oxygenation, .water = 0.65}, dermisThickness);
    material.roughness = 0.45;
    describeBySlabs(material, {epidermis, dermis});
    return material;
}

std::optional<SkinRecipe> askForSkin(QWidget* parent) {
    using R = SkinRecipe;
    static const std::array table{
        row<R, &R::melanin>("skin.melanin", "Melanin", "", 0, 0.6, false,
                            "Share of the epidermis: 0.01 is fair, 0.4 very dark"),
        row<R, &R::eumelanin>("skin.eumelanin", "Eumelanin", "", 0, 1, false,
                              "Brown and black share of the melanin; the rest is red and yellow"),
        row<R, &R::haemoglobin>("skin.haemoglobin", "Blood", "", 0, 0.2, false,
                                "Share of the dermis that is blood: 0.002 to 0.07"),
        row<R, &R::oxygenation>("skin.oxygenation", "Oxygenation", "", 0, 1, false,
                                "Share of the haemoglobin that carries oxygen"),
        row<R, &R::epidermis>("skin.epidermis", "Epidermis", "mm", 0.02, 1, true, "Thickness of the epidermis")};
    return ask<R>(parent, "Skin by melanin and blood", table);
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

std::optional<MediumRecipe> askForMedium(QWidget* parent) {
    using R = MediumRecipe;
    static const std::array table{
        row<R, &R::red>("medium.red", "Colour, red", "", 0, 1, false, "Diffuse albedo, linear"),
        row<R, &R::green>("medium.green", "Colour, green", "", 0, 1, false, "Diffuse albedo, linear"),
        row<R, &R::blue>("medium.blue", "Colour, blue", "", 0, 1, false, "Diffuse albedo, linear"),
        row<R, &R::radius>("medium.radius", "Mean free path", "mm", 0.01, 100, true, "OpenPBR's subsurface_radius"),
        row<R, &R::radiusRed>("medium.radiusRed", "Scale, red", "", 0, 1, false, "OpenPBR's subsurface_radius_scale"),
        row<R, &R::radiusGreen>("medium.radiusGreen", "Scale, green", "", 0, 1, false,
                                "OpenPBR's subsurface_radius_scale"),
        row<R, &R::radiusBlue>("medium.radiusBlue", "Scale, blue", "", 0, 1, false,
                               "OpenPBR's subsurface_radius_scale"),
        row<R, &R::anisotropy>("medium.anisotropy", "Anisotropy", "", -0.9, 0.9, false,
                               "Of Henyey and Greenstein: above 0 light goes on forwards")};
    return ask<R>(parent, "Medium by mean free path", table);
}

} // namespace nacre::view
