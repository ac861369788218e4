#include "tests/gpu/timing/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace nacre::tests {
namespace {

// The times between the timestamps of `repeats` recordings in one command buffer.
std::vector<double> runRepeats(Gpu& gpu, const Variant& variant, std::uint32_t repeats) {
    const auto queries = static_cast<std::uint32_t>(variant.passes.size() + 1);
    variant.begin();
    return gpu.runTimed(queries * repeats, [&](VkCommandBuffer commandBuffer, VkQueryPool pool) {
        for (std::uint32_t i = 0; i < repeats; ++i) {
            variant.record(commandBuffer, pool, i * queries);
        }
    });
}

struct Samples {
    std::vector<double> steady, single;
    std::vector<std::vector<double>> passes;
};

void addSteady(Samples& samples, std::span<const double> steps, std::size_t passCount) {
    // A repeat is its passes and the gap to the next one's first timestamp; the last has no next one.
    for (std::size_t first = 0; first + passCount < steps.size(); first += passCount + 1) {
        const auto begin = steps.begin() + static_cast<std::ptrdiff_t>(first);
        samples.steady.push_back(std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(passCount) + 1, 0.0));
        for (std::size_t pass = 0; pass < passCount; ++pass) {
            samples.passes[pass].push_back(steps[first + pass]);
        }
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
            runRepeats(gpu, variants[i], settings.repeats);
        } while (std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() <
                 settings.warmUpMilliseconds);
    }
    for (std::uint32_t round = 0; round < settings.rounds; ++round) {
        for (std::size_t i = 0; i < variants.size(); ++i) {
            addSteady(samples[i], runRepeats(gpu, variants[i], settings.repeats), variants[i].passes.size());
        }
        for (std::size_t i = 0; i < variants.size(); ++i) {
            for (std::uint32_t single = 0; single < settings.singles; ++single) {
                const std::vector<double> steps = runRepeats(gpu, variants[i], 1);
                samples[i].single.push_back(std::accumulate(steps.begin(), steps.end(), 0.0));
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
