#include "bench/effect/context_times.hpp"

#include "bench/effect/effect_context.hpp"
#include "bench/effect/effect_options.hpp"
#include "bench/techniques.hpp"

#include <chrono>
#include <cstdio>

namespace nacre::bench {
namespace {

double millisecondsToMake(const NacreContextInfo& info) {
    const auto start = std::chrono::steady_clock::now();
    const EffectContext effect(info, {});
    return 1000 * secondsSince(start);
}

} // namespace

ContextTime measureContext(renderer::Device& device, NacreTechnique technique, VkExtent2D extent,
                           std::uint32_t warmContexts) {
    const renderer::Gpu& gpu = device.implementation();
    const vk::raii::PipelineCache pipelines(gpu.device, vk::PipelineCacheCreateInfo());
    NacreContextInfo info = renderer::effectContextInfo(gpu);
    info.pipelineCache = *pipelines;
    info.maxExtent = extent;
    info.techniques = 1u << technique;
    ContextTime time{nacreTechniqueString(technique), millisecondsToMake(info), {}};
    std::vector<double> cached;
    for (std::uint32_t i = 0; i < warmContexts; ++i) {
        cached.push_back(millisecondsToMake(info));
    }
    time.cached = summarize(cached);
    return time;
}

std::vector<NacreTechnique> scatterTechniques() {
    std::vector<NacreTechnique> techniques = realTimeTechniques();
    techniques.push_back(NACRE_TECHNIQUE_BRUTE);
    return techniques;
}

std::string contextCsvHeader() {
    return "technique,first_ms,cached_median_ms,cached_p5_ms,cached_p95_ms\n";
}

std::string formatContextCsv(const ContextTime& time) {
    char text[160];
    std::snprintf(text, sizeof text, "%s,%.1f,%.2f,%.2f,%.2f\n", time.technique.c_str(), time.first, time.cached.median,
                  time.cached.p5, time.cached.p95);
    return text;
}

} // namespace nacre::bench
