// The built-in gallery: five procedural bodies on a plinth, of exactly 436,508 triangles (the thesis's budget).
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// Which lights are on: in front of the bodies, behind them, or both.
enum class GalleryLight { Front, Back, Both };

/// Builds the gallery: a head of skin, a jade dragon, the word NACRE in marble, a nautilus shell of ten-layered
/// nacre and a plant with thin leaves. Metres; framed for 16:9; front are a directional key and a point fill, behind
/// is a spot, all with shadows. Deterministic: the same bytes on every machine and in every call.
/// The triangle count includes everything drawn: bodies, pot, plinth and ground. Some seconds of work on two cores.
Scene makeGallery(GalleryLight light = GalleryLight::Both);

/// Its lights alone, at once.
std::vector<Light> galleryLights(GalleryLight light);

} // namespace nacre::scene
