#include "tests/gpu/timing/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace nacre::tests {
namespace {

// The times of `repeats` recordings in one command buffer, from each one's start to the next one's; no timestamp
// inside, so that passes which do not depend on each other may overlap, as they do in an engine.
std::vector<double> runFrames(Gpu& gpu, const Variant& variant, std::uint32_t repeats) {
    variant.begin();
    return gpu.runTimed(repeats + 1, [&](VkCommandBuffer commandBuffer, VkQueryPool pool) {
        for (std::uint32_t i = 0; i < repeats; ++i) {
            vkCmdWriteTimestamp(commandBuffer, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, i);
            variant.record(commandBuffer, VK_NULL_HANDLE, 0);
        }
        vkCmdWriteTimestamp(commandBuffer, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, repeats);
    });
}

// The passes' times, one after the other, of each of `repeats` recordings in one command buffer.
std::vector<std::vector<double>> runPasses(Gpu& gpu, const Variant& variant, std::uint32_t repeats) {
    const std::size_t passCount = variant.passes.size();
    const auto queries = static_cast<std::uint32_t>(passCount + 1);
    variant.begin();
    const std::vector<double> steps =
        gpu.runTimed(queries * repeats, [&](VkCommandBuffer commandBuffer, VkQueryPool pool) {
            for (std::uint32_t i = 0; i < repeats; ++i) {
                variant.record(commandBuffer, pool, i * queries);
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

struct Samples {
    std::vector<double> steady, single;
    std::vector<std::vector<double>> passes;
};

template <typename Range> void append(std::vector<double>& to, const Range& values) {
    to.insert(to.end(), values.begin(), values.end());
}

void addRound(Gpu& gpu, const Variant& variant, const MeasureSettings& settings, Samples& samples) {
    append(samples.steady, runFrames(gpu, variant, settings.repeats));
    const std::vector<std::vector<double>> passes = runPasses(gpu, variant, settings.repeats);
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
        append(samples.passes[pass], passes[pass]);
    }
}

// Two-sided 95 % quantile of Student's t (Abramowitz and Stegun 26.7.5 around the normal's 1.95996).
double studentQuantile(double degrees) {
    constexpr double z = 1.959964;
    return z + (std::pow(z, 3) + z) / (4 * degrees) +
           (5 * std::pow(z, 5) + 16 * std::pow(z, 3) + 3 * z) / (96 * degrees * degrees);
}

} // namespace

Statistics statisticsOf(std::vector<double> samples) {
    std::sort(samples.begin(), samples.end());
    const auto quantile = [&](double share) {
        const double position = share * static_cast<double>(samples.size() - 1);
        const auto low = static_cast<std::size_t>(position);
        const std::size_t high = std::min(low + 1, samples.size() - 1);
        return samples[low] + (position - static_cast<double>(low)) * (samples[high] - samples[low]);
    };
    return {samples.size(), quantile(0.5), quantile(0.05), quantile(0.95)};
}

std::vector<Timing> measure(Gpu& gpu, std::span<const Variant> variants, const MeasureSettings& settings) {
    std::vector<Samples> samples(variants.size());
    for (std::size_t i = 0; i < variants.size(); ++i) {
        samples[i].passes.resize(variants[i].passes.size());
        const auto start = std::chrono::steady_clock::now();
        do {
            runFrames(gpu, variants[i], settings.repeats);
        } while (std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() <
                 settings.warmUpMilliseconds);
    }
    for (std::uint32_t round = 0; round < settings.rounds; ++round) {
        for (std::size_t i = 0; i < variants.size(); ++i) {
            addRound(gpu, variants[i], settings, samples[i]);
        }
        for (std::size_t i = 0; i < variants.size(); ++i) {
            for (std::uint32_t single = 0; single < settings.singles; ++single) {
                append(samples[i].single, runFrames(gpu, variants[i], 1));
            }
        }
    }
    std::vector<Timing> timings;
    for (std::size_t i = 0; i < variants.size(); ++i) {
        Timing& timing = timings.emplace_back();
        timing.name = variants[i].name;
        timing.steady = statisticsOf(samples[i].steady);
        timing.single = statisticsOf(samples[i].single);
        timing.passNames = variants[i].passes;
        for (const std::vector<double>& pass : samples[i].passes) {
            timing.passes.push_back(statisticsOf(pass));
        }
    }
    return timings;
}

Line fitLine(std::span<const double> x, std::span<const double> y) {
    const auto count = static_cast<double>(x.size());
    const double meanX = std::accumulate(x.begin(), x.end(), 0.0) / count;
    const double meanY = std::accumulate(y.begin(), y.end(), 0.0) / count;
    double xx = 0;
    double xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - meanX) * (x[i] - meanX);
        xy += (x[i] - meanX) * (y[i] - meanY);
    }
    Line line;
    line.slope = xy / xx;
    line.intercept = meanY - line.slope * meanX;
    double residual = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        residual += std::pow(y[i] - line.intercept - line.slope * x[i], 2);
    }
    line.confidence = studentQuantile(count - 2) * std::sqrt(residual / (count - 2) / xx);
    return line;
}

} // namespace nacre::tests
