// A material: the layers light scatters through, and how the effect uses them.
#pragma once

#include "nacre/slab_stack.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nacre {

/// Where the albedo (surface colour) is applied: after scattering only, or its square root before and after.
enum class AlbedoUse { Post, PreAndPost };

/// A subsurface material. Exactly one of `layers` and `meanFreePath` describes the profile.
struct Material {
    std::string name;
    std::string description;

    /// [1 … 32 layers] the profile as a sum of Gaussians.
    std::vector<Layer> layers;
    /// [1e-6, 1e4] mm per channel: d of Burley's normalised diffusion (Christensen and Burley 2015), used when `layers`
    /// is empty.
    std::optional<Rgb> meanFreePath;
    /// The stack of physical slabs, top first, that `layers` was fitted to, or nothing: describeBySlabs (layering.hpp)
    /// sets both. References trace the slabs, the effect draws the layers, and a material file holds the slabs alone.
    /// `scale` applies to both.
    std::vector<Slab> slabs;

    AlbedoUse albedoUse = AlbedoUse::Post;
    /// [0, 1] how much of the light scatters; 0 leaves the surface as it is. Result = mix(irradiance, scattered,
    /// strength).
    double strength = 1;
    /// [0, 1] multiplies the light that comes through the body; 1 is what the profile says, 0 lets nothing through.
    /// Diffuse radiance of a closed body = albedo / π · (scattered + translucency · light that came through).
    double translucency = 1;
    /// [0, 1] f of a thin wall, a sheet without an inside such as a leaf or paper: the share of diffuse light that
    /// leaves on the other side. What is reflected is (1 − f) · scattered. 0 = a closed body, which the rest of the
    /// light leaves elsewhere on its surface.
    double diffuseTransmission = 0;
    /// [0, 1] colour of the light that comes through, in place of the albedo. Absent: the albedo.
    std::optional<Rgb> diffuseTransmissionColor;
    /// [1e-6, 1e4] multiplies every length of the profile: 2 scatters twice as far.
    double scale = 1;
    /// Whether pictures with this material keep two surfaces where one is in front of another, as technique
    /// `bank-surfaces` does, when they are scattered with `bank`. More accurate at folds and thin parts, and slower at
    /// edges (docs/scatter.md). Absent: where light goes far (asksForSecondSurfaces).
    std::optional<bool> secondSurfaces;

    /// [0, 1] diffuse albedo for surfaces that bring none of their own.
    Rgb albedo{0.8, 0.8, 0.8};
    double roughness = 0.5; ///< [0, 1] GGX perceptual roughness
    double specular = 0.5;  ///< [0, 1] F0 = 0.08·specular; 0.5 is an index of refraction of 1.5
    /// [0, 1] share of the specular reflection that a second lobe has, as skin's oil and its pores make one: the whole
    /// is (1 − secondLobe) · first + secondLobe · second. 0 = one lobe. Unreal Engine's Lobe Mix.
    double secondLobe = 0;
    /// [0, 4] multiplies the roughness, textured or not, for the second lobe; the product counts as at most 1. In
    /// Unreal Engine's terms Roughness 1 / Roughness 0.
    double secondLobeRoughness = 1;

    bool operator==(const Material&) const = default;
};

/// The material's profile with `scale` applied. Throws std::invalid_argument naming the field when it has none.
std::unique_ptr<Profile> makeProfile(const Material& material);

/// The same profile as Gaussian layers, normalised per channel: the material's own, or burleyLayers of its mean free
/// path. Throws std::invalid_argument as makeProfile does.
std::vector<Layer> makeLayers(const Material& material);

/// Least rms radius [mm] of a profile's widest channel with which a material asks for second surfaces of itself: light
/// that goes so far reaches from one fold of a body as large as a hand to the next. docs/performance.md, "Error on
/// models", has what they gain.
inline constexpr double secondSurfacesRadius = 3;

/// Material::secondSurfaces or, where it is absent, whether the profile reaches secondSurfacesRadius. Throws
/// std::invalid_argument as makeProfile does.
bool asksForSecondSurfaces(const Material& material);

/// One sentence that names the first field out of range and its value; empty when the material is valid.
std::string findFault(const Material& material);

} // namespace nacre
