// What a frame is drawn with.
#pragma once

#include "nacre/nacre_baselines.h"

#include <cstdint>

namespace nacre::renderer {

/// What may change from frame to frame.
struct EffectSettings {
    NacreTechnique technique = NACRE_TECHNIQUE_DEFAULT; ///< how the diffuse light of subsurface materials is spread
    bool scatter = true;
    bool transmit = true;
    std::uint32_t burleySampleBudget = 0; ///< [1 … 256] most samples per pixel; 0 = the effect's default
    NacreBaselineSettings baselines{};    ///< the baked kernel is the first material's, for all
};

struct RenderSettings : EffectSettings {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t shadowMapSize = 2048;
    /// [1 … 4] samples per axis and pixel: n² samples are tone mapped and averaged.
    std::uint32_t samples = 1;
    /// Adds half a bit of noise before rounding to 8 bits, against banding in smooth gradients.
    bool dither = false;
    /// Adds the pass "copy" after the effect: it reads irradiance, depth and material ids, writes as much as a scatter
    /// pass does, and is what no technique can be faster than.
    bool copyFloor = false;
    /// Transmission writes Output::Thickness, which takes a little longer.
    bool thickness = false;
    /// [count] most repetitions that renderEffect may be asked for
    std::uint32_t effectRepetitions = 0;
    /// Draws all shadow maps in every frame, as if all lights moved; else only those that are not what they were.
    bool shadowMapsEveryFrame = false;
};

/// What the timestamps of a frame are written around.
enum class Timing {
    Passes, ///< every pass
    Whole   ///< the frame: none in between, which could keep passes from overlapping; the pass "copy" is left out
};

} // namespace nacre::renderer
