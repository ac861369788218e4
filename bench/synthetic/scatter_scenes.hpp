// Synthetic G-buffers that are hard for screen-space scattering: hard shadows, silhouettes, slopes, thin parts, masks.
#pragma once

#include "nacre/material.hpp"
#include "nacre/profile.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nacre::bench {

/// A G-buffer as seen by a pinhole camera in the middle of the image, square pixels.
struct ScatterScene {
    std::string name;
    int width = 0;
    int height = 0;
    double focalLength = 0;      ///< px
    std::vector<Rgb> irradiance; ///< row 0 at the top
    std::vector<double> depth;   ///< mm along the view direction
    std::vector<Rgb> normal;     ///< of the surface, unit length, in the camera's axes: x right, y down, z away
    std::vector<std::uint8_t> materialId; ///< 0 = no subsurface scattering; i = materials[i − 1]
    std::vector<Material> materials;
    std::vector<std::unique_ptr<Profile>> profiles; ///< of the materials

    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
    bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

enum class SceneKind { Plane, Spheres, Tilt, Thin, Floor, Terrain, Boxes, Sheets, Foliage, Hair };
const char* sceneKindName(SceneKind kind);
/// What the bank's constants were chosen on.
inline constexpr SceneKind tunedSceneKinds[] = {SceneKind::Plane, SceneKind::Spheres, SceneKind::Tilt, SceneKind::Thin};
/// What they were not chosen on.
inline constexpr SceneKind heldOutSceneKinds[] = {SceneKind::Floor,  SceneKind::Terrain, SceneKind::Boxes,
                                                  SceneKind::Sheets, SceneKind::Foliage, SceneKind::Hair};

struct SceneSettings {
    SceneKind kind = SceneKind::Plane;
    double footprint = 20; ///< px of 12.5 mm at the middle depth: 99.7 % of the widest test material's light
    int width = 320;
    int height = 180;
    std::uint32_t seed = 1;          ///< positions, sizes, shadows
    double shift = 0;                ///< px the camera has moved, along the diagonal, at the middle depth
    double zoom = 1;                 ///< multiplies the focal length
    std::vector<Material> materials; ///< empty = testMaterials()
};

/// Skin (d'Eon and Luebke), marble (Jimenez), and two of Burley's profiles.
std::vector<Material> testMaterials();
ScatterScene makeScatterScene(const SceneSettings& settings);

} // namespace nacre::bench
