// The built-in gallery: five procedural bodies of exactly 436,508 triangles (the thesis's budget), a plinth and ground.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// Which lights are on: in front of the bodies, behind them, or both.
enum class GalleryLight { Front, Back, Both };

/// Builds the gallery. Deterministic: the same bytes on every machine and in every call.
/// The triangle count includes everything drawn: bodies, plinth and ground.
Scene makeGallery(GalleryLight light = GalleryLight::Both);

} // namespace nacre::scene
