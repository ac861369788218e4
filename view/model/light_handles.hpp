// Lights as something in the picture that a mouse takes hold of.
#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <span>
#include <vector>

namespace nacre::view {

/// Where a light is in the picture: places [0, 1], right and down. A directional light is on a sphere around what the
/// camera looks at, on the side that it comes from. One that stands outside the picture is at its rim.
struct LightHandle {
    std::size_t light = 0; ///< index among the lights
    glm::vec2 place{0};
    glm::vec2 end{0};    ///< of a line from `place`, the way the light travels; a point light has none
    bool behind = false; ///< beyond what the camera looks at

    bool operator==(const LightHandle&) const = default;
};

/// The handles of the lights that are before the camera. `aspect` is the picture's width over its height.
std::vector<LightHandle> lightHandles(std::span<const scene::Light> lights, const scene::Camera& camera, float aspect);

/// What a drag does. A directional light is always turned.
enum class LightDrag {
    Move, ///< in the plane of the picture
    Aim   ///< a spot shines at the place, at the depth of what the camera looks at
};

/// The light after its handle was dragged to `place`. `behind`: a directional light goes on the far half of its sphere.
/// Nothing where the place is outside of that sphere.
std::optional<scene::Light> draggedLight(const scene::Light& light, const scene::Camera& camera, float aspect,
                                         glm::vec2 place, LightDrag drag, bool behind);

/// The light nearer to the camera (factor < 1) or farther from it, at the same place of the picture; a directional one
/// stays.
scene::Light pushedLight(const scene::Light& light, const scene::Camera& camera, float factor);

/// A light of a kind where its handle can be seen, and that shines on what the camera looks at.
scene::Light newLight(scene::LightKind kind, const scene::Camera& camera, double metersPerUnit);

} // namespace nacre::view
