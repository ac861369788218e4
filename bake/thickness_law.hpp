// How much light goes how far, and what a mean of it says of a body's thickness.
#pragma once

#include "nacre/profile.hpp"

#include <vector>

namespace nacre::bake {

/// The light T(c) that a chord of length c lets through, and the slab that lets through as much as all chords together.
///
/// A slab of thickness t, looked into in every direction with the cosine's weight, has the mean transmittance
/// S(t) = ∫₀¹ 2µ T(t/µ) dµ, since the chord at the cosine µ is t/µ. The local thickness of a point whose chords have
/// the mean M is the t with S(t) = M: a slab's own thickness, whatever T is.
class ThicknessLaw {
public:
    /// Neutral, of no material: T(c) = 1/c. It has no length of its own, so that a body twice as large is twice as
    /// thick everywhere, and the nearest way out counts most, as it does to light. S(t) = 2/(3t).
    ThicknessLaw() = default;
    /// T is the profile's slab transmittance, the mean of its three channels.
    explicit ThicknessLaw(const Profile& profile);

    /// T of a chord [> 0] mm; 1/mm when neutral. 0 for an infinite one.
    double transmittance(double chord) const;
    /// S⁻¹ of a mean of transmittances [≥ 0], mm, at most longest().
    double thickness(double mean) const;
    /// S(t) of a thickness [> 0] mm.
    double slabMean(double thickness) const;

    /// Beyond it less than 1e-4 of the light comes through, mm; infinite when neutral.
    double longest() const;

private:
    double reach_ = 0;            ///< mm, beyond which T is 0; 0 when neutral
    std::vector<double> chords_;  ///< T at even steps from 0 to reach_
    std::vector<double> lengths_; ///< mm, growing
    std::vector<double> slabs_;   ///< S of lengths_, falling
};

} // namespace nacre::bake
