// The subsurface parameters of OpenPBR Surface, which material files may use by their own names and MaterialX documents
// bring. Part of target nacre::files.
#pragma once

#include "nacre/material.hpp"

namespace nacre {

/// What OpenPBR Surface 1.1 says of light under a surface, with its defaults; names and ranges are the specification's.
struct OpenPbr {
    Rgb baseColor{0.8, 0.8, 0.8};            ///< [0, 1] base_color, of the share that does not scatter
    double subsurfaceWeight = 0;             ///< [0, 1] subsurface_weight
    Rgb subsurfaceColor{0.8, 0.8, 0.8};      ///< [0, 1] subsurface_color: diffuse albedo of the medium
    double subsurfaceRadius = 1;             ///< [0, 1e6] mm subsurface_radius: mean free path where the scale is 1
    Rgb subsurfaceRadiusScale{1, 0.5, 0.25}; ///< [0, 1e6] subsurface_radius_scale
    double subsurfaceAnisotropy = 0;         ///< [−1, 1] subsurface_scatter_anisotropy
    double specularWeight = 1;               ///< [0, 1e6] specular_weight: multiplies the reflection
    double specularRoughness = 0.3;          ///< [0, 1] specular_roughness
    double specularIor = 1.5;                ///< [1, 3] specular_ior
    bool thinWalled = false;                 ///< geometry_thin_walled: a sheet; the radius then has no meaning
};

/// The first value out of its range, as "subsurface_weight is 2, must be 0 to 1"; "" where all are in theirs.
std::string findFault(const OpenPbr& surface);

/// The material: strength is the weight, the albedo the mix of both colours, the mean free path burleyMeanFreePath's; a
/// thin wall lets (1 + g)/2 through. What is beyond Material's range of lengths is cut off at its end. The surface is
/// free of faults.
Material materialOf(const OpenPbr& surface);

} // namespace nacre
