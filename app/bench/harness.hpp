// Measures configurations: warm-up, then rounds in which every configuration of a series takes its turn.
#pragma once

#include "app/bench/plan.hpp"
#include "app/bench/results.hpp"
#include "renderer/device.hpp"

#include <functional>

namespace nacre::bench {

struct HarnessSettings {
    std::uint32_t warmUpFrames = 3;  ///< per configuration, before the first round
    std::uint32_t rounds = 25;       ///< turns of each configuration
    std::uint32_t framesPerTurn = 4; ///< measured frames of a turn
    bool settle = true;              ///< leave out one frame after each change of configuration
    /// Turns in which whole frames are drawn; in the others the effect alone is repeated on the last frame's images.
    std::uint32_t wholeFrameRounds = 25;
    double secondsPerSeries = 120; ///< no further round begins after this long, but there are always three
};

/// One line on what is being done.
using Reporter = std::function<void(const std::string&)>;

struct SeriesResult {
    std::vector<Measurement> measurements;
    std::vector<NoiseFloor> noiseFloors; ///< one for each picture size
};

/// Measures every configuration of a series, the first one of each picture size twice.
SeriesResult measure(renderer::Device& device, const Series& series, const HarnessSettings& settings,
                     const Reporter& say);

} // namespace nacre::bench
