#include "bench/effect/gpu_timing.hpp"

namespace nacre::bench {
namespace {

using renderer::Gpu;
using CommandBuffer = vk::raii::CommandBuffer;

/// Records between `count` timestamps, submits and waits; the microseconds from each to the next.
template <typename Record> std::vector<double> timesBetween(Gpu& gpu, std::uint32_t count, const Record& record) {
    const std::uint32_t bits = gpu.physicalDevice.getQueueFamilyProperties()[gpu.queueFamily].timestampValidBits;
    if (bits == 0) {
        throw renderer::RendererError("the Vulkan device '" + gpu.description.name + "' has no timestamps");
    }
    const std::uint64_t valid = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    const vk::raii::QueryPool pool(gpu.device, {.queryType = vk::QueryType::eTimestamp, .queryCount = count});
    gpu.submitAndWait([&](const CommandBuffer& commandBuffer) {
        commandBuffer.resetQueryPool(*pool, 0, count);
        record(commandBuffer, static_cast<VkQueryPool>(*pool));
    });
    const auto [result, ticks] =
        pool.getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                       vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    std::vector<double> microseconds;
    for (std::uint32_t i = 1; i < count; ++i) {
        microseconds.push_back(static_cast<double>((ticks[i] - ticks[i - 1]) & valid) *
                               static_cast<double>(gpu.limits.timestampPeriod) * 1e-3);
    }
    return microseconds;
}

// `repeats` recordings in one command buffer, from each one's start to the next one's; no timestamp inside, so that
// passes which do not depend on each other may overlap, as they do in an engine.
std::vector<double> runRepeats(Gpu& gpu, const TimedWork& work, std::uint32_t repeats) {
    work.begin();
    return timesBetween(gpu, repeats + 1, [&](const CommandBuffer& commandBuffer, VkQueryPool pool) {
        for (std::uint32_t i = 0; i < repeats; ++i) {
            commandBuffer.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, pool, i);
            work.record(commandBuffer, VK_NULL_HANDLE, 0);
        }
        commandBuffer.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, pool, repeats);
    });
}

// Each pass's times in `repeats` recordings in one command buffer.
std::vector<std::vector<double>> runPasses(Gpu& gpu, const TimedWork& work, std::uint32_t repeats) {
    const std::size_t passCount = work.passes.size();
    const auto queries = static_cast<std::uint32_t>(passCount + 1);
    work.begin();
    const std::vector<double> steps =
        timesBetween(gpu, queries * repeats, [&](const CommandBuffer& commandBuffer, VkQueryPool pool) {
            for (std::uint32_t i = 0; i < repeats; ++i) {
                work.record(commandBuffer, pool, i * queries);
            }
        });
    std::vector<std::vector<double>> passes(passCount);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (i % queries < passCount) { // else it is the gap to the next recording
            passes[i % queries].push_back(steps[i]);
        }
    }
    return passes;
}

void append(std::vector<double>& to, const std::vector<double>& values) {
    to.insert(to.end(), values.begin(), values.end());
}

// One work and what it took.
struct TimedTurns {
    const TimedWork* work;
    std::vector<double> steady, single;
    std::vector<std::vector<double>> passes;

    void warmUp(Gpu& gpu, const GpuTimingSettings& settings) const {
        const auto start = std::chrono::steady_clock::now();
        do {
            runRepeats(gpu, *work, settings.repeats);
        } while (1000 * secondsSince(start) < settings.warmUpMilliseconds);
    }

    void addRepeats(Gpu& gpu, const GpuTimingSettings& settings) {
        append(steady, runRepeats(gpu, *work, settings.repeats));
        const std::vector<std::vector<double>> times = runPasses(gpu, *work, settings.repeats);
        for (std::size_t pass = 0; pass < times.size(); ++pass) {
            append(passes[pass], times[pass]);
        }
    }

    void addSingles(Gpu& gpu, const GpuTimingSettings& settings) {
        for (std::uint32_t i = 0; i < settings.singles; ++i) {
            append(single, runRepeats(gpu, *work, 1));
        }
    }

    WorkTimes summary() const {
        WorkTimes times{work->name, summarize(steady), summarize(single), work->passes, {}};
        for (const std::vector<double>& pass : passes) {
            times.passes.push_back(summarize(pass));
        }
        return times;
    }
};

} // namespace

std::vector<WorkTimes> timeInTurns(Gpu& gpu, std::span<const TimedWork> works, const GpuTimingSettings& settings,
                                   const TurnProgress& progress) {
    std::vector<TimedTurns> all;
    for (const TimedWork& work : works) {
        all.push_back({&work, {}, {}, std::vector<std::vector<double>>(work.passes.size())});
    }
    std::vector<Turn> turns;
    for (TimedTurns& one : all) {
        turns.push_back({[&] { one.warmUp(gpu, settings); },
                         {[&](std::uint32_t) { one.addRepeats(gpu, settings); },
                          [&](std::uint32_t) { one.addSingles(gpu, settings); }}});
    }
    takeTurns(turns, {.rounds = settings.rounds, .leastRounds = settings.rounds}, progress);
    std::vector<WorkTimes> times;
    for (const TimedTurns& one : all) {
        times.push_back(one.summary());
    }
    return times;
}

} // namespace nacre::bench
