// What there is at a place of the picture, and why the effect does what it does there.
#pragma once

#include "renderer/frame_settings.hpp"
#include "view/model/edited_scene.hpp"

#include <memory>
#include <optional>
#include <string>

namespace nacre::trace {
class Geometry;
}

namespace nacre::view {

struct Inspection {
    std::string body;          ///< the instance's name
    std::uint32_t surface = 0; ///< index into Scene::surfaces
    std::optional<std::size_t> material;
    double pixelsPerMillimeter = 0; ///< at that depth
    std::string sentence;           ///< whether light scatters and comes through there; if not, why
};

/// Looks where a click went: `place` [0, 1], right and down, in a picture of `width` by `height` px. Nothing where the
/// camera sees no surface. `geometry` is of the same scene.
std::optional<Inspection> inspect(const trace::Geometry& geometry, const EditedScene& edited,
                                  const scene::Camera& camera, const renderer::EffectSettings& effect, glm::dvec2 place,
                                  std::uint32_t width, std::uint32_t height);

} // namespace nacre::view
