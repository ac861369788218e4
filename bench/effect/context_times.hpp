// How long the effect's context takes to make, technique by technique.
#pragma once

#include "bench/time_statistics.hpp"
#include "nacre/nacre.h"
#include "renderer/graphics_device.hpp"

#include <string>
#include <vector>

namespace nacre::bench {

struct ContextTime {
    std::string technique;
    double first = 0; ///< ms
    Summary cached;   ///< ms, of further ones, whose pipelines are in a pipeline cache
};

/// Makes a context for pictures of up to this size, and `warmContexts` [>= 1] more. Nearly all of the first time is the
/// driver's compiler. A driver may keep what it has compiled on the disk from one run to the next (NVIDIA's does unless
/// __GL_SHADER_DISK_CACHE=0, Mesa's unless MESA_SHADER_CACHE_DISABLE=1): `first` is the time of a new machine only
/// where that is off.
ContextTime measureContext(renderer::Device& device, NacreTechnique technique, VkExtent2D extent,
                           std::uint32_t warmContexts);

/// The real-time techniques, and `brute` last.
std::vector<NacreTechnique> scatterTechniques();

/// The header of the table, and a line of it.
std::string contextCsvHeader();
std::string formatContextCsv(const ContextTime& time);

} // namespace nacre::bench
