// GPU times of whatever records into a command buffer, taken in turn.
#pragma once

#include "bench/time_statistics.hpp"
#include "bench/turns.hpp"
#include "renderer/vulkan/open_device.hpp"

namespace nacre::bench {

/// Something to time.
struct TimedWork {
    std::string name;
    std::vector<std::string> passes;
    /// Called once per command buffer, before `record` is called several times.
    std::function<void()> begin;
    /// Writes timestamps first … first + passes.size() around and between its passes, or none where the pool is null.
    std::function<void(const vk::raii::CommandBuffer& commandBuffer, VkQueryPool pool, std::uint32_t first)> record;
};

struct WorkTimes {
    std::string name;
    Summary steady; ///< µs from one repeat's start to the next one's, many in a command buffer
    Summary single; ///< µs of a lone repeat, submitted and waited for
    std::vector<std::string> passNames;
    std::vector<Summary> passes; ///< µs, of repeats with timestamps between the passes, which then do not overlap
};

struct GpuTimingSettings {
    std::uint32_t rounds = 12;       ///< everything once a round, in turn
    std::uint32_t repeats = 20;      ///< in a row in one command buffer: the steady time
    std::uint32_t singles = 5;       ///< lone command buffers a round
    double warmUpMilliseconds = 300; ///< of each before the first round, so that clocks rise
};

/// Throws renderer::RendererError where the device has no timestamps.
std::vector<WorkTimes> timeInTurns(renderer::Gpu& gpu, std::span<const TimedWork> works,
                                   const GpuTimingSettings& settings, const TurnProgress& progress);

} // namespace nacre::bench
