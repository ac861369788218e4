// The built-in sky.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// The built-in sky as an equirectangular image: zenith over horizon over ground.
nacre::Image makeSky(const Environment& environment);

} // namespace nacre::scene
