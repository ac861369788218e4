// Reads a frame's images back as floats. Internal to the renderer.
#pragma once

#include "renderer/frame.hpp"
#include "renderer/offscreen.hpp"

namespace nacre::renderer {

/// Waits for the device. `images` hold the frame that used the effect as `use` says.
Pixels readOutput(Gpu& gpu, Output output, const FrameImages& images, const EffectUse& use);

} // namespace nacre::renderer
