// A scene's lights as the effect's NacreLight, and the layers of their shadow maps. Internal to the renderer.
#pragma once

#include "nacre/nacre.h"
#include "renderer/passes/shader_types.h"
#include "renderer/point_clusters.hpp"
#include "scene/scene.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nacre::renderer {

/// Most lights of a scene, as NacreContextInfo::maxLights.
inline constexpr std::size_t maxLights = 1024;

struct LightSet {
    std::vector<NacreLight> lights;
    std::vector<shared::LightConstants> constants; ///< the same, for the renderer's own passes
    std::vector<shared::ShadowLayer> shadowLayers; ///< in the order of the array layers
};

/// Places lights over one scene's geometry. A directional light's map is square in world space and fits what can throw
/// a shadow; a spot's covers its cone; a point light has six faces, and so has a spot whose cone is wide.
class LightPlacement {
public:
    /// Places the scene's own lights. `shadowMapSize` [px] sets the margin the filter needs.
    LightPlacement(const scene::Scene& scene, std::uint32_t shadowMapSize);

    /// From now on `place` refuses more than these, too.
    void limit(std::size_t lights, std::size_t shadowLayers);
    /// Lights that are as they were in the last call keep their place without being looked at again. Throws
    /// RendererError for more than maxLights, and for a light with faulty values; the last set then stays.
    void place(std::span<const scene::Light> lights);
    const LightSet& placed() const { return set_; }

    /// The outline of an instance in world space, and what it is along its first triangle's normal.
    struct Body {
        PointClusters points;
        glm::vec3 normal{0};         ///< zero where no triangle has an area
        Interval own{};              ///< along the normal
        std::optional<Interval> all; ///< the whole scene along it, of flat bodies
        bool shinesThrough = false;  ///< has a subsurface material
    };
    /// A light in its place; its shadow layers count from 0.
    struct Placed {
        scene::Light source;
        NacreLight light;
        std::vector<shared::ShadowLayer> layers;
    };

private:
    void findGrounds();
    Placed placeAnew(const scene::Light& light) const;
    LightSet gather(const std::vector<Placed>& placed) const;

    float metersPerUnit_;
    float margin_; ///< of the maps, as a share of their half side
    std::vector<Body> bodies_;
    std::vector<Placed> placed_;
    LightSet set_;
    std::size_t mostLights_ = maxLights;
    std::size_t mostShadowLayers_ = 6 * maxLights;
};

} // namespace nacre::renderer
