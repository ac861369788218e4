// context_timing: how long nacreCreateContext takes, technique by technique, as CSV.
// Nearly all of it is the driver's compiler. A driver may keep what it has compiled on the disk from one run to the
// next (NVIDIA's does unless __GL_SHADER_DISK_CACHE=0), so `first` is only the time of a new machine where that is off.
#include "tests/gpu/support/effect.hpp"
#include "tests/gpu/timing/measure.hpp"
#include "tests/gpu/timing/timing_options.hpp"

#include <chrono>
#include <cstdio>
#include <exception>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr int warmContexts = 9;

double createMilliseconds(Gpu& gpu, const NacreContextInfo& info) {
    const auto start = std::chrono::steady_clock::now();
    const Effect effect(gpu, info);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void measureTechnique(Gpu& gpu, NacreTechnique technique) {
    NacreContextInfo info = gpu.contextInfo({1920, 1080});
    info.techniques = 1u << technique;
    info.shaderFloat16 = gpu.shaderFloat16;
    const VkPipelineCacheCreateInfo cacheInfo{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    if (vkCreatePipelineCache(gpu.device, &cacheInfo, nullptr, &info.pipelineCache) != VK_SUCCESS) {
        throw std::runtime_error("vkCreatePipelineCache failed");
    }
    const double first = createMilliseconds(gpu, info);
    std::vector<double> warm;
    for (int i = 0; i < warmContexts; ++i) {
        warm.push_back(createMilliseconds(gpu, info));
    }
    const Statistics cached = statisticsOf(warm);
    std::printf("%s,%.1f,%.2f,%.2f,%.2f\n", nacreTechniqueString(technique), first, cached.median, cached.p5,
                cached.p95);
    std::fflush(stdout);
    vkDestroyPipelineCache(gpu.device, info.pipelineCache, nullptr);
}

} // namespace

int main() {
    try {
        Gpu gpu(false);
        std::fprintf(stderr, "%s, driver %u, half floats %s\n", gpu.properties.deviceName, gpu.properties.driverVersion,
                     gpu.shaderFloat16 ? "on" : "off");
        std::puts("technique,first_ms,cached_median_ms,cached_p5_ms,cached_p95_ms");
        std::vector<NacreTechnique> techniques = realTimeTechniques();
        techniques.push_back(NACRE_TECHNIQUE_BRUTE);
        for (const NacreTechnique technique : techniques) {
            measureTechnique(gpu, technique);
        }
        return 0;
    } catch (const std::exception& exception) {
        std::fprintf(stderr, "context_timing: %s\n", exception.what());
        return 1;
    }
}
