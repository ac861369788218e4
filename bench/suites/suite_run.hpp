// Runs a suite.
#pragma once

#include "bench/suites/series_run.hpp"
#include "bench/suites/suites.hpp"

#include <filesystem>

namespace nacre::bench {

/// Measures everything in the plan. The pictures are written to `folder`.
Results runPlan(renderer::Device& device, const Plan& plan, const SuiteSettings& suite,
                const std::filesystem::path& folder, const Reporter& say);

} // namespace nacre::bench
