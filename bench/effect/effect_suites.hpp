// GPU times of the scatter techniques and of transmit on synthetic scenes, beside a copy pass.
#pragma once

#include "bench/effect/effect_options.hpp"
#include "bench/effect/scatter_subject.hpp"
#include "renderer/graphics_device.hpp"

#include <iosfwd>

namespace nacre::bench {

/// What EffectTimingOptions::suite may be: "scenes", "held-out", …, "all".
std::vector<std::string> effectSuiteNames();

/// A line of the table.
struct EffectTime {
    ScatterSubject subject;
    WorkTimes times;
};

/// Measures the suite and prints to `out` as it goes: medians [5 %, 95 %] of steady repeats and of lone frames, and of
/// every pass; for series also the line through their medians.
/// Throws renderer::RendererError.
std::vector<EffectTime> runEffectSuite(renderer::Device& device, const EffectTimingOptions& options,
                                       const Reporter& say, std::ostream& out);

/// All figures as a table, one line each, header first.
std::string formatEffectCsv(std::span<const EffectTime> rows);

} // namespace nacre::bench
