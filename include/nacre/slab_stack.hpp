// Slabs of physical media, which lie on top of each other in a layered material.
#pragma once

#include "nacre/media.hpp"
#include "nacre/skin.hpp"

#include <optional>
#include <span>

namespace nacre {

/// A layer of a physical material; infinite thickness is allowed for the last one.
struct Slab {
    Medium medium;        ///< refractiveIndex is absolute (air is 1); thicknesses and coefficients in mm and 1/mm
    double thickness = 0; ///< [≥ 1e-6] mm
    /// What the medium's absorption was computed from, where the slab is skin (`makeSkinSlab`).
    std::optional<SkinContent> skin;

    bool operator==(const Slab&) const = default;
};

/// That of most soft tissue (Jacques 2013), and of a slab in a file that gives none.
inline constexpr double tissueRefractiveIndex = 1.4;

/// A slab of skin: absorption by skinAbsorption, reduced scattering by skinReducedScattering, tissueRefractiveIndex and
/// an anisotropy of 0.8, of the size published for skin in visible light (van Gemert, Jacques, Sterenborg and Star
/// 1989, "Skin optics"). Throws std::invalid_argument naming the field.
Slab makeSkinSlab(const SkinContent& content, double thickness);

/// "slabs[1].thickness is 0, …": the first field out of range of a stack of [1 … 32] slabs, top first; empty when it
/// is valid.
std::string findFault(std::span<const Slab> slabs);

} // namespace nacre
