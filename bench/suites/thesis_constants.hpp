// Every figure that the thesis states about its measurements: D. Andersen, "Screen-Space Subsurface Scattering: A
// Real-time Implementation Using Direct3D 11.1 Rendering API", Blekinge Institute of Technology; chapters 2.3 and 4.5.
#pragma once

namespace nacre::bench::thesis {

inline constexpr const char* machine =
    "NVIDIA GeForce GT 555M, Intel Core i7-2630QM 2.00 GHz, 8 GB DDR3, Windows 7, Direct3D 11.1 (chapter 2.3)";

/// Chapter 4.5: triangles of its five models, and the side of its shadow maps.
inline constexpr unsigned triangles = 436'508;
inline constexpr unsigned shadowMapSize = 2048;

/// Chapter 4.5.2: what one more texel of blur radius costs, µs.
inline constexpr double radiusSlope720 = 500;
inline constexpr double radiusSlope1080 = 1000;

/// Chapter 4.5.2: the largest radius, and what it takes at 1920x1080, µs ("closer to 18" ms, 55 frames per second).
inline constexpr int largestRadius = 13;
inline constexpr double largestRadiusTime1080 = 18'000;

/// Chapter 4.5: a series ends when a frame takes longer than this, µs.
inline constexpr double timeLimit = 18'000;

} // namespace nacre::bench::thesis
