#include "core/files/open_pbr.hpp"

#include "nacre/media.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nacre {
namespace {

/// [mm] Spread of light in a sheet, for which the radius says nothing; the same as for thin walls of glTF.
constexpr double thinWallMeanFreePath = 0.3;
/// [mm] Material::meanFreePath's range.
constexpr double shortestMeanFreePath = 1e-6;
constexpr double longestMeanFreePath = 1e4;
/// ±1 are outside the phase function's range.
constexpr double mostAnisotropic = 0.99;

std::string faultOf(const char* name, double value, double low, double high) {
    if (value >= low && value <= high) {
        return "";
    }
    std::ostringstream text;
    text << name << " is " << value << ", must be " << low << " to " << high;
    return text.str();
}

std::string faultOf(const char* name, const Rgb& values, double low, double high) {
    for (const double value : values) {
        if (std::string fault = faultOf(name, value, low, high); !fault.empty()) {
            return fault;
        }
    }
    return "";
}

Rgb clampLengths(Rgb lengths) {
    for (double& length : lengths) {
        length =
            std::isfinite(length) ? std::clamp(length, shortestMeanFreePath, longestMeanFreePath) : longestMeanFreePath;
    }
    return lengths;
}

} // namespace

std::string findFault(const OpenPbr& surface) {
    constexpr double most = 1e6;
    for (std::string fault :
         {faultOf("base_color", surface.baseColor, 0, 1), faultOf("subsurface_weight", surface.subsurfaceWeight, 0, 1),
          faultOf("subsurface_color", surface.subsurfaceColor, 0, 1),
          faultOf("subsurface_radius", surface.subsurfaceRadius, 0, most),
          faultOf("subsurface_radius_scale", surface.subsurfaceRadiusScale, 0, most),
          faultOf("subsurface_scatter_anisotropy", surface.subsurfaceAnisotropy, -1, 1),
          faultOf("specular_weight", surface.specularWeight, 0, most),
          faultOf("specular_roughness", surface.specularRoughness, 0, 1),
          faultOf("specular_ior", surface.specularIor, 1, 3)}) {
        if (!fault.empty()) {
            return fault;
        }
    }
    return "";
}

Material materialOf(const OpenPbr& surface) {
    const double anisotropy = std::clamp(surface.subsurfaceAnisotropy, -mostAnisotropic, mostAnisotropic);
    const double reflection = (surface.specularIor - 1) / (surface.specularIor + 1);
    Material material;
    material.strength = surface.subsurfaceWeight;
    material.roughness = surface.specularRoughness;
    material.specular = std::min(surface.specularWeight * reflection * reflection / 0.08, 1.0);
    Rgb radius;
    for (std::size_t i = 0; i < radius.size(); ++i) {
        material.albedo[i] = std::lerp(surface.baseColor[i], surface.subsurfaceColor[i], surface.subsurfaceWeight);
        radius[i] = surface.subsurfaceRadius * surface.subsurfaceRadiusScale[i];
    }
    if (surface.thinWalled) {
        material.meanFreePath = Rgb{thinWallMeanFreePath, thinWallMeanFreePath, thinWallMeanFreePath};
        material.diffuseTransmission = surface.subsurfaceWeight * (1 + anisotropy) / 2;
    } else {
        material.meanFreePath =
            clampLengths(burleyMeanFreePath(surface.subsurfaceColor, clampLengths(radius), anisotropy));
    }
    return material;
}

} // namespace nacre
