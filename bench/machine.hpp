// What a benchmark runs on: processor and clocks, as far as the system tells.
#pragma once

#include "bench/results/results.hpp"

#include <string_view>

namespace nacre::bench {

/// The processor's name; "unknown" where the system does not tell.
std::string processorName();

/// Frequencies of the device of this name, MHz, in Clock::before: from NVIDIA's management library, from the kernel's
/// files of AMD and Intel, and for a software device the processor's. Empty where none can be read.
std::vector<Clock> readClocks(std::string_view device, bool software);

} // namespace nacre::bench
