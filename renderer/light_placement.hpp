// A scene's lights, placed for shading and for their shadow maps. Internal to the renderer.
#pragma once

#include "renderer/passes/shader_types.h"
#include "scene/scene.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace nacre::renderer {

/// Most lights of a scene, as NacreContextInfo::maxLights.
inline constexpr std::size_t maxLights = 1024;

/// A light and the conventions of its shadow map; the fields are NacreLight's (include/nacre/nacre.h).
struct PlacedLight {
    scene::LightKind kind = scene::LightKind::Directional;
    glm::vec3 position{0}; ///< directional: where the shadow map's depth is 0
    glm::vec3 direction{0, -1, 0};
    glm::vec3 irradiance{1};
    float range = 0; ///< scene units, 0 = unlimited
    float innerConeAngle = 0;
    float outerConeAngle = 0;
    std::uint32_t shadowLayer = shared::noShadow;
    glm::mat4 shadowClipFromWorld{1}; ///< directional, spot
    float shadowRange = 1;            ///< scene units
};

struct LightSet {
    std::vector<PlacedLight> lights;
    std::vector<shared::ShadowLayer> shadowLayers; ///< in the order of the array layers
};

/// Places every light of the scene. A directional light's map is square in world space and fits what can throw a
/// shadow; a spot's covers its cone; a point light has six faces. `shadowMapSize` [px] sets the margin the filter
/// needs. Throws RendererError for more than maxLights, and for a light with faulty values.
LightSet placeLights(const scene::Scene& scene, std::uint32_t shadowMapSize);

shared::LightConstants makeConstants(const PlacedLight& light, float metersPerUnit);

} // namespace nacre::renderer
