// Measures configurations: warm-up, then rounds in which every configuration of a series takes its turn.
#pragma once

#include "bench/results/results.hpp"
#include "bench/suites/suite_plan.hpp"
#include "bench/turns.hpp"
#include "renderer/graphics_device.hpp"

namespace nacre::bench {

struct HarnessSettings {
    std::uint32_t warmUpFrames = 3;   ///< effects per configuration, before the first round
    double warmUpSeconds = 0.5;       ///< of frames without a pause before the first round, so that clocks rise
    std::uint32_t rounds = 13;        ///< turns of each configuration
    std::uint32_t frameRounds = 13;   ///< those that begin with two frames, see below
    std::uint32_t effectsPerTurn = 8; ///< measured repetitions of the effect on the last frame's images
    bool settle = true;               ///< leave out one repetition before them
    double secondsPerSeries = 120;    ///< from its start; no further round begins later, but there are always three
};

struct SeriesResult {
    std::vector<Measurement> measurements;
    std::vector<NoiseFloor> noiseFloors; ///< at most two for each picture size
};

/// Measures every configuration of a series, and the first and the last one of each picture size twice, the second time
/// on images of its own.
///
/// A turn begins with a frame that has a timestamp around every pass, and one with timestamps around the whole. They
/// also keep the device busy: its clocks fall where a turn only repeats an effect of some 100 µs.
SeriesResult measure(renderer::Device& device, const Series& series, const HarnessSettings& settings,
                     const Reporter& say);

} // namespace nacre::bench
