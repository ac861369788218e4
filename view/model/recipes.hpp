// Materials told by what they are made of, which collapse to layers.
#pragma once

#include "nacre/material.hpp"
#include "view/model/edit_parameters.hpp"

namespace nacre::view {

/// Skin in two slabs, epidermis over a deep dermis.
struct SkinRecipe {
    double melanin = 0.04;     ///< [0, 1] share of the epidermis
    double eumelanin = 0.7;    ///< [0, 1] share of the melanin
    double haemoglobin = 0.03; ///< [0, 1] share of the dermis: blood
    double oxygenation = 0.75; ///< [0, 1]
    double epidermis = 0.1;    ///< [mm] thickness
};
std::vector<Slab> skinSlabs(const SkinRecipe& recipe);
Material mixSkin(const SkinRecipe& recipe);
std::span<const Parameter<SkinRecipe>> skinParameters();

/// A medium as OpenPBR tells it: colour, mean free path and its scale per channel, anisotropy.
struct MediumRecipe {
    double red = 0.8; ///< [0, 1] diffuse albedo
    double green = 0.6;
    double blue = 0.5;
    double radius = 1;    ///< [mm] mean free path
    double radiusRed = 1; ///< [0, 1] of it
    double radiusGreen = 0.5;
    double radiusBlue = 0.25;
    double anisotropy = 0; ///< [-1, 1]
};
Material mixMedium(const MediumRecipe& recipe);
std::span<const Parameter<MediumRecipe>> mediumParameters();

/// The numbers of a slab. What is set of its melanin, blood and the like makes it a slab of skin; what is set of its
/// coefficients makes it a slab of any medium.
std::span<const Parameter<Slab>> slabParameters();

/// `material` with its profile, albedo and specular by these slabs. Throws std::invalid_argument naming the field.
Material mixSlabs(Material material, std::vector<Slab> slabs);

} // namespace nacre::view
